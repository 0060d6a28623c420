# SPDX-License-Identifier: BSD-3-Clause
"""apps/examples/plot_run.py, as it is installed"""

import os
import pathlib
import subprocess
import sys

SCRIPT = pathlib.Path(os.environ["LOCKBOX_PACKAGE"]).parents[2] / "share/lockbox/examples/plot_run.py"

STATES = """timestamp,tx,ty,tz,qx,qy,qz,qw,door,status,door.sigma
0,nan,nan,nan,nan,nan,nan,nan,nan,initializing,nan
0.1,0,0,1,0,0,0,1,0.1,tracking,0.01
0.2,0,0.1,1,0,0,0,1,0.1,tracking,inf
"""


def plot(*arguments):
    return subprocess.run([sys.executable, "-B", SCRIPT, *arguments], capture_output=True,
                          text=True)


def test_run_becomes_a_picture(tmp_path):
    (tmp_path / "states.csv").write_text(STATES)
    picture = tmp_path / "run.svg"
    result = plot(tmp_path, "--output", picture)
    assert result.returncode == 0, result.stderr
    text = picture.read_text()
    assert "2 of 3 frames tracked" in text and "<!-- door -->" in text
    assert plot(tmp_path / "states.csv", "--output", tmp_path / "run.png").returncode == 0
    assert (tmp_path / "run.png").read_bytes().startswith(b"\x89PNG")


def test_what_is_no_run_is_refused_with_its_name(tmp_path):
    result = plot(tmp_path, "--output", tmp_path / "run.png")
    assert result.returncode == 3
    assert "states.csv" in result.stderr and "Traceback" not in result.stderr
    (tmp_path / "states.csv").write_text(STATES.splitlines()[0] + "\n")
    assert "holds no rows" in plot(tmp_path, "--output", tmp_path / "run.png").stderr
