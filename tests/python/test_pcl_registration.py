# SPDX-License-Identifier: BSD-3-Clause
"""docs/pcl-registration.md as a reader follows it: the program on PCL, changed as it is told, built against the
installed library by the commands that stand there, and run on a scan."""

import os
import pathlib
import subprocess

import numpy as np
import pytest

import lockbox
from document import code_blocks

PREFIX = pathlib.Path(os.environ["LOCKBOX_PACKAGE"]).parents[2]
EXAMPLES = PREFIX / "share" / "lockbox" / "examples"
K = np.array([[285.0, 0, 159.5], [0, 285, 119.5], [0, 0, 1]])
JOINTS = {"drawer": 0.03, "door": 0.1}


@pytest.fixture
def document(docs):
    return docs / "pcl-registration.md"


def changed(program, diff):
    """The program with the lines that the diff takes away or adds; its comments are not told there."""
    left = program.splitlines()
    result = []
    for line in filter(None, diff.splitlines()[2:]):
        if line[0] == "+":
            result.append(line[1:])
            continue
        place = left.index(line[1:])
        result += left[:place] if line[0] == "-" else left[:place + 1]
        left = left[place + 1:]
    return "\n".join(result + left) + "\n"


def without_comments(program):
    return [line for line in program.splitlines() if line and not line.startswith("//")]


def test_told_changes_make_one_program_of_the_other(document):
    (diff,) = code_blocks(document, "diff")
    told = changed((EXAMPLES / "pcl_icp.cpp").read_text(), diff)
    swapped = (EXAMPLES / "pcl_articulated_sdf.cpp").read_text()
    assert sorted(without_comments(told)) == sorted(without_comments(swapped))


def write_scan(file):
    """A cabinet before a wall, as an organized cloud; what was not measured is NaN."""
    base = np.diag([1.0, -1.0, -1.0, 1.0])
    base[2, 3] = 1.2
    depth, _ = lockbox.load_model("cabinet").render(lockbox.State(base, JOINTS), K, (240, 320))
    z = np.where(depth > 0, depth, 1.9)
    v, u = np.mgrid[:240, :320]
    points = np.stack([(u - K[0, 2]) / K[0, 0] * z, (v - K[1, 2]) / K[1, 1] * z, z], -1)
    points[:, :20] = np.nan
    lines = ["VERSION 0.7", "FIELDS x y z", "SIZE 4 4 4", "TYPE F F F", "COUNT 1 1 1", "WIDTH 320",
             "HEIGHT 240", "VIEWPOINT 0 0 0 1 0 0 0", "POINTS 76800", "DATA ascii"]
    lines += [f"{x:.6f} {y:.6f} {z:.6f}" for x, y, z in points.reshape(-1, 3)]
    file.write_text("\n".join(lines) + "\n")


def test_the_swapped_program_is_built_and_finds_pose_and_joints(document, tmp_path):
    write_scan(tmp_path / "scan.pcd")
    (tmp_path / "CMakeLists.txt").write_text(code_blocks(document, "cmake")[0])
    (commands,) = code_blocks(document, "sh")
    ran = subprocess.run(["bash", "-e", "-u", "-c", commands], cwd=tmp_path, capture_output=True,
                         text=True, env={**os.environ, "PREFIX": str(PREFIX)})
    assert ran.returncode == 0, ran.stdout + ran.stderr
    pose = ran.stdout.split("pose of the model:")[1].split("joints:")[0].split()
    assert [float(number) for number in pose[3:12:4]] == pytest.approx([0, 0, 1.2], abs=0.004)
    joints = [float(number) for number in ran.stdout.split("joints:")[1].split()]
    for position in JOINTS.values():
        assert min(abs(joint - position) for joint in joints) < 0.01, joints
