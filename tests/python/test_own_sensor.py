# SPDX-License-Identifier: BSD-3-Clause
"""docs/how-to/own-sensor.md as a reader follows it, with a virtual camera whose noise is known."""

import os
import pathlib
import shlex
import subprocess
import sys

import numpy as np
import pytest

from document import code_blocks
from virtual_camera import virtual_camera

DISTANCES = (0.6, 1.2, 2.0)  # metres
CONSTANT, QUADRATIC = 0.001, 0.003  # metres, 1/metre
OWN_SHARE, LENGTH = 0.6, 3.0  # pixels


def smooth(noise):
    """Errors that correlate as exp(-r^2 / (2 LENGTH^2)), with a standard deviation of 1."""
    frequencies = [2 * np.pi * np.fft.fftfreq(size) for size in noise.shape]
    squares = np.add.outer(frequencies[0] ** 2, frequencies[1] ** 2)
    blurred = np.fft.ifft2(np.fft.fft2(noise) * np.exp(-LENGTH**2 * squares / 4)).real
    return blurred / blurred.std()


def wall(z, width, height):
    """Seen square on, in millimetres."""
    random = np.random.default_rng(5)
    own, shared = random.normal(size=(2, height, width))
    error = OWN_SHARE * own + np.sqrt(1 - OWN_SHARE**2) * smooth(shared)
    depth = z + (CONSTANT + QUADRATIC * z * z) * error
    return np.round(1000 * depth).astype("<u2").tobytes()


def values_of(profile):
    words = profile.replace("{", " ").replace("}", " ").replace(",", " ").split()
    names = ("constant:", "quadratic:", "own_share:", "correlation_length:")
    return [float(words[words.index(name) + 1]) for name in names]


def test_a_wall_tells_how_the_sensor_errs(docs, tool, recording, tmp_path):
    document = docs / "how-to" / "own-sensor.md"
    (program,) = code_blocks(document, "python")
    (tmp_path / "measure_wall.py").write_text(program)
    (tmp_path / "recording").symlink_to(recording)
    distances = iter(DISTANCES)
    environment = {**os.environ, "PATH": f"{pathlib.Path(tool).parent}:{os.environ['PATH']}"}
    printed = ""
    for command in "".join(code_blocks(document, "sh")).splitlines():
        is_live = "openni2:" in shlex.split(command)
        camera = tmp_path / "camera"
        if is_live:
            z = next(distances)
            with virtual_camera(camera, lambda width, height: wall(z, width, height)):
                ran = run(command, tmp_path, {**environment, "LOCKBOX_VIRTUAL_DEPTH": str(camera)})
            camera.unlink()
        else:
            ran = run(command, tmp_path, environment)
        printed += ran
    constant, quadratic, own_share, length = values_of((tmp_path / "my_sensor.yaml").read_text())
    for z in DISTANCES:
        assert constant + quadratic * z * z == pytest.approx(CONSTANT + QUADRATIC * z * z, rel=0.1)
    assert own_share == pytest.approx(OWN_SHARE, abs=0.1)
    assert abs(length - LENGTH) <= 1
    assert 0 < float(printed.splitlines()[-1]) < 2


def run(command, folder, environment):
    own = command.replace("python3 ", f"{sys.executable} ")  # which has the package
    ran = subprocess.run(["bash", "-c", own], cwd=folder, env=environment, capture_output=True,
                         text=True)
    assert ran.returncode == 0, command + "\n" + ran.stdout + ran.stderr
    return ran.stdout
