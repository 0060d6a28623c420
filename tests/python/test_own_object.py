# SPDX-License-Identifier: BSD-3-Clause
"""docs/how-to/own-object.md as a reader follows it: files and commands, as they stand there and in their
order. Recordings are made short; the camera is a virtual one, and windows are on a virtual display."""

import os

from document import code_blocks, opens_window, run, shorten
from virtual_camera import virtual_camera

SHORT = {"simulate": "--frames 12", "record": "--seconds 0.5"}
NEVER_TRACKED = 5  # the virtual camera looks at a wall


def test_the_tool_box_goes_all_the_way(docs, tool, display, tmp_path):
    document = docs / "how-to" / "own-object.md"
    shorten(tool, SHORT, tmp_path / "bin")
    (parts,) = code_blocks(document, "python")
    (urdf,) = code_blocks(document, "xml")
    (tmp_path / "parts.py").write_text(parts)
    (tmp_path / "toolbox.urdf").write_text(urdf)
    with virtual_camera(tmp_path / "camera") as socket:
        environment = {**os.environ, "DISPLAY": display, "LOCKBOX_VIRTUAL_DEPTH": str(socket),
                       "PATH": f"{tmp_path / 'bin'}:{os.environ['PATH']}"}
        for command in "".join(code_blocks(document, "sh")).splitlines():
            lasts = opens_window(command)
            expected = {130 if lasts else NEVER_TRACKED if "out/real" in command else 0}
            assert run(command, tmp_path, environment, lasts) in expected, command
    rows = (tmp_path / "out/run/states.csv").read_text().splitlines()
    assert len(rows) == 13 and sum(",tracking," in row for row in rows) == 12
    for made in ("body.png", "toolbox.png", "out/errors/summary.json"):
        assert (tmp_path / made).exists(), made
