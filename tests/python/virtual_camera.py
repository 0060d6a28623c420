# SPDX-License-Identifier: BSD-3-Clause
"""A virtual depth camera made of what docs/recordings.md says of it."""

import contextlib
import socket
import struct
import threading
import time

MODES = [(640, 480, 30, 1000), (320, 240, 60, 1000)]  # width, height, frames a second, unit


def flat_wall(width, height):
    """1.5 m away, in millimetres."""
    return struct.pack("<H", 1500) * (width * height)


def serve(server, image):
    """The image, for one user after the other."""
    while True:
        try:
            connection = server.accept()[0]
        except OSError:
            return  # closed
        try:
            width, height, rate, unit = MODES[0]
            connection.sendall(struct.pack("<8sIIIIffII", b"LBXDEPTH", 2, width, height, rate,
                                           1.0, 0.79, unit, 0))
            connection.sendall(struct.pack("<I4I", 1, *MODES[1]))
            chosen = connection.recv(4)
            if len(chosen) < 4:
                continue  # looked at only
            width, height, rate, unit = MODES[struct.unpack("<I", chosen)[0]]
            pixels = image(width, height)
            for number in range(10**6):
                connection.sendall(struct.pack("<Q", number * 1000000 // rate) + pixels)
                time.sleep(1 / rate)
        except OSError:
            pass  # its user has enough
        finally:
            connection.close()


@contextlib.contextmanager
def virtual_camera(path, image=flat_wall):
    """While it lasts, the camera is at this path. image(width, height): what its next user sees."""
    server = socket.socket(socket.AF_UNIX)
    server.bind(str(path))
    server.listen()
    thread = threading.Thread(target=serve, args=(server, image), daemon=True)
    thread.start()
    yield path
    server.shutdown(socket.SHUT_RDWR)
    server.close()
    thread.join()
