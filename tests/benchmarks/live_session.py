#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""A long live session: a virtual camera that is unplugged and stalls now and then, and the tool that
tracks what it delivers and records it. Prints what was delivered, what became of it, and how much
memory the tool took.

  PYTHONPATH=build/lib/python3/dist-packages tests/benchmarks/live_session.py MODEL DEPTH_FOLDER \
      OUTPUT [SECONDS]
"""

import math
import pathlib
import re
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import time

import lockbox

RATE = 30  # frames a second
TOOL = pathlib.Path(__file__).parents[2] / "build" / "bin" / "lockbox"
UNPLUG_EACH, UNPLUGGED = 97.0, 5.0  # seconds
STALL_EACH, STALLED = 61.0, 3.0


class Camera:
    """Plays frames forwards and backwards, as long as it lives."""

    def __init__(self, path, folder):
        frames = list(lockbox.open_source(folder))
        self.path = path
        self.header = self.header_of(frames[0])
        self.images = [frame.depth.tobytes() for frame in frames + frames[-2:0:-1]]
        self.sent = 0
        self.is_stalled = False
        self.begin = time.monotonic()

    @staticmethod
    def header_of(frame):
        height, width = frame.depth.shape
        focal = frame.intrinsics[0, 0], frame.intrinsics[1, 1]
        fields = [2 * math.atan(0.5 * pixels / f)
                  for pixels, f in zip((width, height), focal)]
        return struct.pack("<8sIIIIffII", b"LBXDEPTH", 1, width, height, RATE, *fields,
                           round(1e6 * frame.metres_per_unit), 0)

    def plug_in(self):
        self.server = socket.socket(socket.AF_UNIX)
        self.path.unlink(missing_ok=True)
        self.server.bind(str(self.path))
        self.server.listen()
        self.connection = None
        self.thread = threading.Thread(target=self.serve, daemon=True)
        self.thread.start()

    def unplug(self):
        self.server.shutdown(socket.SHUT_RDWR)
        if self.connection:
            self.connection.shutdown(socket.SHUT_RDWR)
        self.thread.join()
        self.server.close()
        self.path.unlink()

    def serve(self):
        while True:
            try:
                self.connection = self.server.accept()[0]
            except OSError:
                return  # unplugged
            try:
                self.connection.sendall(self.header)
                while True:
                    time.sleep(max(0.0, self.begin + self.sent / RATE - time.monotonic()))
                    if not self.is_stalled:
                        stamp = round(1e6 * (time.monotonic() - self.begin))
                        image = self.images[self.sent % len(self.images)]
                        self.connection.sendall(struct.pack("<Q", stamp) + image)
                    self.sent = max(self.sent + 1,
                                    round((time.monotonic() - self.begin) * RATE))
            except OSError:
                self.connection.close()


def memory_of(process):
    """Resident megabytes."""
    status = pathlib.Path(f"/proc/{process.pid}/status").read_text()
    return int(re.search(r"VmRSS:\s+(\d+)", status)[1]) / 1024


def disturb(camera, since):
    """Whatever is due in this second; returns what was done."""
    if since and since % UNPLUG_EACH < 1.0 <= since:
        camera.unplug()
        time.sleep(UNPLUGGED)
        camera.plug_in()
        return 1, 0
    if since and since % STALL_EACH < 1.0 <= since:
        camera.is_stalled = True
        time.sleep(STALLED)
        camera.is_stalled = False
        return 0, 1
    return 0, 0


def main(model, folder, output, seconds):
    camera = Camera(pathlib.Path(tempfile.mkdtemp()) / "camera", folder)
    camera.plug_in()
    run = subprocess.Popen(
        [TOOL, "track", "--model", model, "--source", f"openni2:virtual-depth:{camera.path}",
         "--output", output, "--record", pathlib.Path(output) / "session.oni", "--quiet"])
    start, memory, unplugged, stalled = time.monotonic(), [], 0, 0
    while time.monotonic() - start < seconds and run.poll() is None:
        since = time.monotonic() - start
        memory.append((since, memory_of(run)))
        before = time.monotonic()
        happened = disturb(camera, since)
        unplugged, stalled = unplugged + happened[0], stalled + happened[1]
        time.sleep(max(0.0, 1.0 - (time.monotonic() - before)))
    run.send_signal(signal.SIGINT)
    status = run.wait()
    states = (pathlib.Path(output) / "states.csv").read_text().splitlines()
    told = (pathlib.Path(output) / "run.yaml").read_text()
    recorded = sum(1 for _ in lockbox.open_source(pathlib.Path(output) / "session.oni"))
    settled = [value for when, value in memory if when > 0.1 * seconds]
    print(f"{seconds:.0f} s, exit status {status}; unplugged {unplugged} times, stalled {stalled}")
    print(f"rows {len(states) - 1}; recorded {recorded}; run.yaml: " + ", ".join(
        f"{key} {re.search(rf'{key}: (.*)', told)[1]}"
        for key in ("total", "tracking", "uncertain", "lost", "dropped", "outages")))
    print(f"memory: {settled[0]:.1f} MB after a tenth of the time, {settled[-1]:.1f} at the end, "
          f"{max(settled):.1f} at most; at each tenth " + ", ".join(
              f"{settled[len(settled) * tenth // 9]:.1f}" for tenth in range(9)))
    return 0 if status == 130 else 1


if __name__ == "__main__":
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:4], float(sys.argv[4]) if len(sys.argv) > 4 else 600.0))
