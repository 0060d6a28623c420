# SPDX-License-Identifier: BSD-3-Clause
"""Models of uncommon size or shape: long chains, links and triangles without extent, joints that
cannot move."""
import os
import subprocess

import pytest

import depth_images

# Of a processor; 256 slats take 5.
SECONDS = 60
PITCH = 0.01  # metres from slat to slat


def lockbox(*arguments):
    return subprocess.run(["bash", "-c", f"ulimit -t {SECONDS}; exec \"$@\"", "limited",
                           os.environ["LOCKBOX_TOOL"], *map(str, arguments)],
                          capture_output=True, text=True, check=False)


def link(name, *shapes):
    return (f'<link name="{name}">' + "".join(
        f"<visual><geometry>{shape}</geometry></visual>" for shape in shapes) + "</link>\n")


def joint(name, parent, child, limits, origin="0 0 0"):
    return (f'<joint name="{name}" type="revolute"><parent link="{parent}"/>'
            f'<child link="{child}"/><origin xyz="{origin}"/><axis xyz="0 1 0"/>'
            f'<limit {limits} effort="1" velocity="1"/></joint>\n')


def write_urdf(file, *elements):
    file.write_text('<robot name="model">\n' + "".join(elements) + "</robot>\n")
    return file


def write_shutter(file, slats):
    """A roller shutter: slats in a row, each hinged to the one before."""
    shape = f'<box size="{PITCH - 0.001} 0.1 0.01"/>'
    return write_urdf(
        file, *(link(f"slat{i}", shape) for i in range(slats)),
        *(joint(f"hinge{i}", f"slat{i - 1}", f"slat{i}", 'lower="-0.5" upper="0.5"',
                f"{PITCH} 0 0") for i in range(1, slats)))


def write_flat_state(file, slats):
    """The shutter flat, across the image's middle, as far away as it is long."""
    hinges = [f"hinge{i}" for i in range(1, slats)]
    length = PITCH * slats
    file.write_text(",".join(["timestamp,tx,ty,tz,qx,qy,qz,qw", *hinges]) + "\n" +
                    f"0,{-length / 2},0,{length},0,0,0,1" + ",0" * len(hinges) + "\n")
    return file


@pytest.mark.parametrize("slats", [64, 256])
def test_chains_are_loaded_and_followed_in_bounded_time(slats, tmp_path):
    model = write_shutter(tmp_path / "shutter.urdf", slats)
    state = write_flat_state(tmp_path / "start.csv", slats)
    result = lockbox("inspect", "--model", model)
    assert result.returncode == 0, result.stderr
    result = lockbox("simulate", "--model", model, "--trajectory", state, "--frames", 1,
                     "--output", tmp_path / "images")
    assert result.returncode == 0, result.stderr
    result = lockbox("track", "--model", model, "--source", tmp_path / "images",
                     "--initial-state", state, "--output", tmp_path / "run", "--quiet")
    assert result.returncode in (0, 5), result.stderr
    assert len((tmp_path / "run/states.csv").read_text().splitlines()) == 2


def track_at_rest(model, folder):
    """Simulates a frame of the model at rest, a metre away, and tracks it; returns the row."""
    (folder / "camera.yaml").write_text(depth_images.camera_info(160, 120))
    result = lockbox("simulate", "--model", model, "--trajectory", "auto", "--frames", 1,
                     "--camera-info", folder / "camera.yaml", "--output", folder / "images")
    assert result.returncode == 0, result.stderr
    result = lockbox("track", "--model", model, "--source", folder / "images", "--initial-state",
                     folder / "images/groundtruth.csv", "--output", folder / "run", "--quiet")
    assert result.returncode in (0, 5), result.stderr
    names, row = (folder / "run/states.csv").read_text().splitlines()
    return dict(zip(names.split(","), row.split(",")))


def test_links_without_geometry_are_frames(tmp_path):
    model = write_urdf(
        tmp_path / "frames.urdf", link("base", '<box size="0.3 0.2 0.1"/>'), link("empty"),
        link("leaf", '<box size="0.1 0.1 0.1"/>'), link("tip"),
        joint("first", "base", "empty", 'lower="0" upper="1"', "0 0 -0.1"),
        joint("second", "empty", "leaf", 'lower="0" upper="1"'),
        joint("third", "leaf", "tip", 'lower="0" upper="1"'))
    assert lockbox("inspect", "--model", model).returncode == 0
    row = track_at_rest(model, tmp_path)
    assert row["third.sigma"] == "inf"  # what it moves cannot be seen


def test_a_joint_without_a_range_stays(tmp_path):
    model = write_urdf(
        tmp_path / "stuck.urdf", link("base", '<box size="0.3 0.2 0.1"/>'),
        link("leaf", '<box size="0.1 0.1 0.1"/>'),
        joint("stuck", "base", "leaf", 'lower="0.25" upper="0.25"', "0 0 -0.1"))
    assert "stuck" in lockbox("inspect", "--model", model).stderr  # it cannot move
    assert float(track_at_rest(model, tmp_path)["stuck"]) == 0.25


BLOCK = """v -.1 -.1 -.1\nv .1 -.1 -.1\nv .1 .1 -.1\nv -.1 .1 -.1
v -.1 -.1 .1\nv .1 -.1 .1\nv .1 .1 .1\nv -.1 .1 .1
f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8
"""


def test_triangles_without_area_do_not_count(tmp_path):
    model = tmp_path / "block.obj"
    model.write_text(BLOCK)
    sound = lockbox("inspect", "--model", model)
    assert sound.returncode == 0, sound.stderr
    # An edge there and back, a point three times, and the middle of an edge.
    model.write_text(BLOCK + "f 1 2 1\nf 3 3 3\nv 0 -.1 -.1\nf 1 9 2\n")
    degenerate = lockbox("inspect", "--model", model)
    assert degenerate.returncode == 0, degenerate.stderr
    assert degenerate.stdout == sound.stdout


def test_a_mesh_of_nothing_else_is_refused(tmp_path):
    model = tmp_path / "nothing.obj"
    model.write_text("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\nf 1 1 2\n")
    result = lockbox("inspect", "--model", model)
    assert result.returncode == 3
    assert "nothing.obj" in result.stderr
