# SPDX-License-Identifier: BSD-3-Clause
"""The commands of docs/how-to/live.md, as they stand there, on a virtual camera."""

import os
import pathlib
import re
import signal
import subprocess

import pytest

from document import code_blocks, end_after_rows
from virtual_camera import virtual_camera

SOURCES = pathlib.Path(__file__).parents[2] / "modules" / "capture" / "src"


@pytest.fixture
def environment(tool, tmp_path):
    with virtual_camera(tmp_path / "camera") as path:
        yield {**os.environ, "LOCKBOX_VIRTUAL_DEPTH": str(path),
               "PATH": f"{pathlib.Path(tool).parent}:{os.environ['PATH']}"}


@pytest.fixture
def document(docs):
    return docs / "how-to" / "live.md"


def test_list_looks_like_the_example(document, environment):
    listed = subprocess.run(["bash", "-c", code_blocks(document, "sh")[0]], env=environment,
                            capture_output=True, text=True)
    assert listed.returncode == 0, listed.stderr
    example = code_blocks(document, "text")[0].splitlines()
    keys = [line.split(":")[0] for line in example]
    lines = listed.stdout.splitlines()
    assert [line.split(":")[0] for line in lines] == keys
    assert [line for line in lines if "mode:" in line] == [
        line for line in example if "mode:" in line]


def test_messages_of_the_table_are_said(document):
    text = "".join(file.read_text() for file in SOURCES.glob("*.cpp"))
    text = re.sub(r'"\s+"', "", text)  # literals over several lines
    messages = re.findall(r"^\| `([^`]+)` \| ", document.read_text(), re.MULTILINE)
    assert len(messages) == 6
    for message in messages:
        assert message.split(" /")[0] in text, message


def run_until_ctrl_c(command, environment, folder, output):
    """Ends the command when it has written rows."""
    run = subprocess.Popen(
        command.split(), env=environment, cwd=folder, stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE, text=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
    end_after_rows(run, folder / output / "states.csv")
    errors = run.communicate()[1]
    assert run.returncode == 130, errors
    return (folder / output / "run.yaml").read_text()


def test_tracking_runs_until_ctrl_c(document, environment, tmp_path):
    description = run_until_ctrl_c(code_blocks(document, "sh")[1], environment, tmp_path,
                                   "out/live")
    assert (tmp_path / "out" / "live.oni").stat().st_size > 0
    assert "outages: 0" in description


def test_mode_is_taken(document, environment, tmp_path):
    description = run_until_ctrl_c(code_blocks(document, "sh")[2], environment, tmp_path,
                                   "out/fast")
    assert "{width: 320, height: 240" in description
