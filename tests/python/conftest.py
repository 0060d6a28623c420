# SPDX-License-Identifier: BSD-3-Clause
"""What the tests share: the tool, and a small recording of a shipped model."""

import os
import pathlib
import shutil
import socket
import subprocess

import pytest

CAMERA = """image_width: 160
image_height: 120
camera_matrix: {rows: 3, cols: 3, data: [142, 0, 79.5, 0, 142, 59.5, 0, 0, 1]}
distortion_model: plumb_bob
distortion_coefficients: {rows: 1, cols: 5, data: [0, 0, 0, 0, 0]}
"""


@pytest.fixture(scope="session")
def tool():
    """The lockbox tool."""
    return os.environ["LOCKBOX_TOOL"]


@pytest.fixture(scope="session")
def recording(tool, tmp_path_factory):
    """A folder of 30 depth images of a rigid block that moves, with groundtruth.csv."""
    folder = tmp_path_factory.mktemp("recording")
    (folder / "camera.yaml").write_text(CAMERA)
    subprocess.run(
        [tool, "simulate", "--model", "rigid_block", "--trajectory", "auto", "--frames", "30",
         "--camera-info", folder / "camera.yaml", "--output", folder / "block", "--quiet"],
        check=True)
    return folder / "block"


@pytest.fixture
def free_port():
    """A port that nobody uses, most probably: the system hands them out in turn."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


@pytest.fixture(scope="session")
def docs():
    """The folder of the documents."""
    return pathlib.Path(__file__).parents[2] / "docs"


@pytest.fixture(scope="session")
def display():
    """One of its own, where there is none."""
    if os.environ.get("DISPLAY"):
        yield os.environ["DISPLAY"]
        return
    if not shutil.which("Xvfb"):
        pytest.skip("there is no display")
    server = subprocess.Popen(["Xvfb", "-displayfd", "1", "-noreset"], stdout=subprocess.PIPE,
                              stderr=subprocess.DEVNULL, text=True)
    yield ":" + server.stdout.readline().strip()
    server.terminate()
    server.wait()
