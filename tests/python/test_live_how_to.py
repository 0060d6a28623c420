# SPDX-License-Identifier: BSD-3-Clause
"""The commands of docs/how-to/live.md, as they stand there, on a virtual camera made of what
docs/file-formats.md says of it."""

import os
import pathlib
import re
import signal
import socket
import struct
import subprocess
import threading
import time

import pytest

from document import code_blocks

WIDTH, HEIGHT = 160, 120
SOURCES = pathlib.Path(__file__).parents[2] / "modules" / "capture" / "src"


def serve(server):
    """A wall, 1.5 m away, for one user after the other."""
    wall = struct.pack("<H", 1500) * (WIDTH * HEIGHT)
    while True:
        try:
            connection = server.accept()[0]
        except OSError:
            return  # closed
        try:
            connection.sendall(struct.pack("<8sIIIIffII", b"LBXDEPTH", 1, WIDTH, HEIGHT, 30,
                                           1.0, 0.79, 1000, 0))
            for number in range(10**6):
                connection.sendall(struct.pack("<Q", number * 33333) + wall)
                time.sleep(1 / 30)
        except OSError:
            connection.close()  # its user has enough


@pytest.fixture
def environment(tool, tmp_path):
    path = tmp_path / "camera"
    server = socket.socket(socket.AF_UNIX)
    server.bind(str(path))
    server.listen()
    thread = threading.Thread(target=serve, args=(server,), daemon=True)
    thread.start()
    yield {**os.environ, "LOCKBOX_VIRTUAL_DEPTH": str(path),
           "PATH": f"{pathlib.Path(tool).parent}:{os.environ['PATH']}"}
    server.shutdown(socket.SHUT_RDWR)
    server.close()
    thread.join()


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
    assert [line.split(":")[0] for line in lines] == sorted(set(keys), key=keys.index)
    assert lines[3] == "  mode: 160x120, 30 Hz, 1 mm (taken)" and "(taken)" in example[3]


def test_messages_of_the_table_are_said(document):
    text = "".join(file.read_text() for file in SOURCES.glob("*.cpp"))
    text = re.sub(r'"\s+"', "", text)  # literals over several lines
    messages = re.findall(r"^\| `([^`]+)` \| ", document.read_text(), re.MULTILINE)
    assert len(messages) == 6
    for message in messages:
        assert message.split(" /")[0] in text, message


def test_tracking_runs_until_ctrl_c(document, environment, tmp_path):
    arguments = code_blocks(document, "sh")[1].split()
    run = subprocess.Popen(
        arguments, env=environment, cwd=tmp_path, stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE, text=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
    states = tmp_path / "out" / "live" / "states.csv"
    for _ in range(600):
        if states.exists() and len(states.read_text().splitlines()) > 3:
            break
        time.sleep(0.05)
    run.send_signal(signal.SIGINT)
    errors = run.communicate()[1]
    assert run.returncode == 130, errors
    assert (tmp_path / "out" / "live.oni").stat().st_size > 0
    assert "outages: 0" in (tmp_path / "out" / "live" / "run.yaml").read_text()
