# SPDX-License-Identifier: BSD-3-Clause
"""The commands of docs/tutorial.md, as they stand there and in their order. Recordings are made small
and short; a camera is a virtual one, and windows are on a virtual display."""

import os
import re
import shutil
import subprocess

import pytest

from conftest import CAMERA
from document import code_blocks, opens_window, run, shorten
from virtual_camera import virtual_camera

# What makes a command short: it is appended to those of this name.
SHORT = {"simulate": "--frames 12 --camera-info camera.yaml", "record": "--seconds 0.5"}

PART = "solid part\n" + "".join(
    "facet normal 0 0 0\nouter loop\n" + "".join(f"vertex {corner}\n" for corner in face) +
    "endloop\nendfacet\n" for face in (
        ("0 0 0", "0 200 0", "200 0 0"), ("0 0 0", "200 0 0", "0 0 200"),
        ("0 0 0", "0 0 200", "0 200 0"), ("200 0 0", "0 200 0", "0 0 200"))) + "endsolid part\n"


@pytest.fixture(scope="module")
def folder(tmp_path_factory, tool):
    """Where a user stands who reads the tutorial."""
    folder = tmp_path_factory.mktemp("tutorial")
    (folder / "camera.yaml").write_text(CAMERA)
    (folder / "part.stl").write_text(PART)
    shorten(tool, SHORT, folder / "bin")
    return folder


@pytest.fixture(scope="module")
def environment(folder, display, tmp_path_factory):
    with virtual_camera(tmp_path_factory.mktemp("camera") / "socket") as socket:
        yield {**os.environ, "LOCKBOX_VIRTUAL_DEPTH": str(socket), "DISPLAY": display,
               "PATH": f"{folder / 'bin'}:{os.environ['PATH']}"}


def test_commands_run_one_after_the_other(docs, folder, environment):
    count = 0
    for block in code_blocks(docs / "tutorial.md", ""):
        if block.startswith("timestamp"):
            (folder / "start.csv").write_text(block)
            continue
        for command in block.splitlines():
            if "--video" in command and not shutil.which("ffmpeg"):
                continue
            # A start beside the object ends a run lost, or never tracked, and is no mistake.
            lasts = opens_window(command)
            expected = {130} if lasts else {0}
            if "--initial-state" in command:
                expected |= {1, 5}
            assert run(command, folder, environment, lasts) in expected, command
            count += 1
    assert count > 8
    out = folder / "out"
    for made in ("cabinet.oni", "groundtruth.csv", "run/states.csv", "snapshots/frame_000000.png",
                 "errors/summary.json", "frame.png", "pictures/frame_000011.png"):
        assert (out / made).exists(), made


def test_keys_of_the_table_are_those_of_the_viewer(docs, tool):
    page = subprocess.run([tool, "view", "--help"], capture_output=True, text=True).stdout
    keys = page[page.index("Keys in the window"):]
    table = re.search(r"\| key \| \|\n\|.*\n((?:\|.*\n)+)", (docs / "tutorial.md").read_text())[1]
    told = {key for row in re.findall(r"^\| ([^|]+) \|", table, re.MULTILINE)
            for key in re.findall(r"\b[a-z]\b", row)}
    known = {key for line in keys.splitlines()
             for key in re.findall(r"\b[a-z]\b", line[:14])}
    assert told == known and {"e", "b", "t", "u", "s", "h"} <= told


BOX = """<robot name="box"><link name="box"><visual><geometry><box size="0.3 0.2 0.1"/></geometry>
</visual></link></robot>
"""


def test_commands_of_the_readme_run(docs, tool, environment, tmp_path):
    block = next(block for block in code_blocks(docs.parent / "README.md", "") if "my_object" in block)
    (tmp_path / "my_object.urdf").write_text(BOX)
    (tmp_path / "build" / "bin").mkdir(parents=True)
    (tmp_path / "build" / "bin" / "lockbox").symlink_to(tool)
    subprocess.run([tool, "record", "--source", "openni2:", "--seconds", "0.5", "--output",
                    tmp_path / "recording.oni"], env=environment, check=True)
    for command in block.splitlines():
        is_live = "openni2:" in command or opens_window(command)
        assert run(command, tmp_path, environment, is_live) == (130 if is_live else 0), command
    assert (tmp_path / "my_object.png").exists() and (tmp_path / "out/run/states.csv").exists()
