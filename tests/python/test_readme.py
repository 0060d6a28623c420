# SPDX-License-Identifier: BSD-3-Clause
"""The examples of README.md and docs/library.md, as they stand there, but for the names of files."""

import os
import pathlib
import re
import subprocess
import sys

import pytest

from document import code_blocks

ROOT = pathlib.Path(__file__).parents[2]
MODEL = ROOT / "share" / "models" / "rigid_block" / "rigid_block.urdf"

# What the examples of C++ use and do not say.
FRAME = """
#include "lockbox/capture/frame_source.hpp"
#include "lockbox/pcl/articulated_sdf_registration.hpp"
#include "lockbox/tracking/tracker.hpp"
int main() {
  [[maybe_unused]] const pcl::PointCloud<pcl::PointXYZ>::Ptr scan;
  [[maybe_unused]] pcl::PointCloud<pcl::PointXYZ> aligned;
  [[maybe_unused]] const Eigen::Matrix4f guess = Eigen::Matrix4f::Identity();
  CODE
}
"""


def own(text, recording):
    """The example with a model and a recording that are there."""
    for name in ("my_object.urdf", "cabinet.urdf"):
        text = text.replace(name, str(MODEL))
    return text.replace("recording.oni", str(recording)).replace("openni2:", str(recording))


def commands(containing):
    blocks = [block for block in code_blocks(ROOT / "README.md", "") if containing in block]
    assert len(blocks) == 1
    return blocks[0].strip().splitlines()


def test_scripts_are_there():
    for command in commands("scripts/demo"):
        assert os.access(ROOT / command.split()[0], os.X_OK), command


def test_own_object_is_inspected_and_tracked(tool, recording, tmp_path):
    inspect, track, view = commands("my_object.urdf")
    for command in (inspect, track.removesuffix(" --view")):  # here is no display
        words = own(command, recording).replace("build/bin/lockbox", tool).split()
        run = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True)
        assert run.returncode in (0, 1), run.stderr  # 1: the object was lost at the end
    assert (tmp_path / "my_object.png").exists()
    assert len((tmp_path / "out" / "run" / "states.csv").read_text().splitlines()) == 31
    told = subprocess.run([tool, "view", "--help"], capture_output=True, text=True).stdout
    for option in re.findall(r"--[a-z-]+", view):
        assert option in told


@pytest.mark.parametrize("document", ["README.md", "docs/library.md"])
def test_programs_compile(document, tmp_path):
    prefix = pathlib.Path(os.environ["LOCKBOX_PACKAGE"]).parents[2]
    listed = subprocess.run(["pkg-config", "--cflags", "lockbox"], check=True, text=True,
                            capture_output=True, env={
                                **os.environ,
                                "PKG_CONFIG_PATH": ":".join(map(str, prefix.glob("lib/**/pkgconfig")))})
    blocks = code_blocks(ROOT / document, "cpp")
    assert blocks
    for number, block in enumerate(blocks):
        source = tmp_path / f"{number}.cpp"
        source.write_text(FRAME.replace("CODE", block))
        compiled = subprocess.run(["g++", "-std=c++20", "-fsyntax-only", *listed.stdout.split(),
                                   source], capture_output=True, text=True)
        assert compiled.returncode == 0, compiled.stderr


def test_python_runs(recording):
    pytest.importorskip("lockbox")
    (code,) = code_blocks(ROOT / "README.md", "python")
    ran = subprocess.run([sys.executable, "-B", "-c", "import lockbox\n" + own(code, recording)],
                         capture_output=True, text=True)
    assert ran.returncode == 0, ran.stderr
    assert len(ran.stdout.splitlines()) == 30
