# SPDX-License-Identifier: BSD-3-Clause
"""Every example of docs/python.md, as it stands there."""

import os
import pathlib
import shutil
import subprocess
import sys

import pytest

from document import code_blocks

DOCUMENT = pathlib.Path(__file__).parents[2] / "docs" / "python.md"


@pytest.fixture(scope="module")
def folder(tool, recording, tmp_path_factory):
    """What the examples name: a recording, and a run on it."""
    place = tmp_path_factory.mktemp("examples")
    shutil.copytree(recording, place / "recording")
    subprocess.run([tool, "track", "--model", "rigid_block", "--source", "recording", "--quiet",
                    "--initial-state", "recording/groundtruth.csv", "--output", "run"],
                   cwd=place, check=True)
    return place


@pytest.mark.parametrize("code", code_blocks(DOCUMENT, "python"), ids=lambda _: "")
def test_example_runs(code, folder):
    result = subprocess.run([sys.executable, "-B", "-c", code], cwd=folder, capture_output=True,
                            text=True)
    assert result.returncode == 0, result.stderr


@pytest.mark.parametrize("command", code_blocks(DOCUMENT, "sh"), ids=lambda _: "")
def test_command_runs(command, folder):
    package = os.environ["LOCKBOX_PACKAGE"]
    built = "build/lib/python3/dist-packages python3"
    assert f"PYTHONPATH={built}" in command
    own = command.replace(built, f"'{package}' {sys.executable}")
    result = subprocess.run(own, shell=True, cwd=folder, capture_output=True, text=True)
    assert result.returncode == 0, result.stderr
    assert "'cabinet', 5 bodies, 4 joints" in result.stdout
