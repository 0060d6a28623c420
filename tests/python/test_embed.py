# SPDX-License-Identifier: BSD-3-Clause
"""The program of docs/how-to/embed.md, built against the installed library by the commands that stand
there, and run on a recording."""

import os
import pathlib
import subprocess

from document import code_blocks

PREFIX = pathlib.Path(os.environ["LOCKBOX_PACKAGE"]).parents[2]


LARGE_CAMERA = """image_width: 320
image_height: 240
camera_matrix: {rows: 3, cols: 3, data: [284, 0, 159.5, 0, 284, 119.5, 0, 0, 1]}
distortion_model: plumb_bob
distortion_coefficients: {rows: 1, cols: 5, data: [0, 0, 0, 0, 0]}
"""


def test_the_program_is_built_and_follows_a_recording(docs, tool, tmp_path):
    (tmp_path / "camera.yaml").write_text(LARGE_CAMERA)
    recording = tmp_path / "block"
    subprocess.run([tool, "simulate", "--model", "rigid_block", "--trajectory", "auto", "--frames", "30",
                    "--camera-info", tmp_path / "camera.yaml", "--output", recording, "--quiet"],
                   check=True)
    document = docs / "how-to" / "embed.md"
    program, frame = code_blocks(document, "cpp")
    (tmp_path / "main.cpp").write_text(program)
    (tmp_path / "CMakeLists.txt").write_text(code_blocks(document, "cmake")[0])
    (tmp_path / "recording").symlink_to(recording)
    (commands,) = code_blocks(document, "sh")
    ran = subprocess.run(["bash", "-e", "-u", "-c", commands], cwd=tmp_path, capture_output=True,
                         text=True, env={**os.environ, "PREFIX": str(PREFIX)})
    assert ran.returncode == 0, ran.stdout + ran.stderr
    rows = [line.split() for line in ran.stdout.splitlines() if line[:1].isdigit()]
    assert len(rows) == 30
    assert {row[1] for row in rows} == {"tracking"}
    refused = subprocess.run([tmp_path / "build" / "follow", "none.urdf", "recording"], cwd=tmp_path,
                             capture_output=True, text=True)
    assert refused.returncode == 3 and "none.urdf" in refused.stderr
    (tmp_path / "main.cpp").write_text(
        '#include "lockbox/core/depth_frame.hpp"\nint main() {\n' + frame + "}\n")
    subprocess.run(["cmake", "--build", tmp_path / "build"], check=True, capture_output=True)
