# SPDX-License-Identifier: BSD-3-Clause
"""Sound files that show nothing, or are of uncommon sizes, and a system that gives too little."""
import csv
import os
import random
import shutil
import subprocess

import pytest

import depth_images

WIDTH, HEIGHT = 160, 120
NEVER_TRACKED = 5


def lockbox(*arguments, limits=""):
    """limits: what the shell's ulimit is given, such as `-n 16`."""
    limited = f"ulimit {limits}; exec \"$@\"" if limits else "exec \"$@\""
    return subprocess.run(["bash", "-c", limited, "limited", os.environ["LOCKBOX_TOOL"],
                           *map(str, arguments)], capture_output=True, text=True, timeout=200,
                          check=False)


@pytest.fixture(scope="module", name="block")
def _block(tmp_path_factory):
    """Three frames of the shipped block, and its states."""
    folder = tmp_path_factory.mktemp("block")
    (folder / "camera.yaml").write_text(depth_images.camera_info(WIDTH, HEIGHT))
    result = lockbox("simulate", "--model", "rigid_block", "--trajectory", "auto", "--frames", 3,
                     "--camera-info", folder / "camera.yaml", "--output", folder / "images")
    assert result.returncode == 0, result.stderr
    return folder / "images"


def track(source, block, run, *more, limits=""):
    return lockbox("track", "--model", "rigid_block", "--source", source, "--initial-state",
                   block / "groundtruth.csv", "--output", run, "--threads", 2, "--quiet", *more,
                   limits=limits)


def rows(run):
    with open(run / "states.csv", newline="") as file:
        return list(csv.DictReader(file))


def _noise():
    draw = random.Random(51)
    return [draw.randrange(65536) for _ in range(WIDTH * HEIGHT)]


@pytest.mark.parametrize("depths", [
    pytest.param([0] * (WIDTH * HEIGHT), id="zero"),
    pytest.param([65535] * (WIDTH * HEIGHT), id="65535"),
    pytest.param(_noise(), id="noise"),
])
def test_frames_that_show_nothing_are_never_tracked(depths, block, tmp_path):
    images = depth_images.write_folder(tmp_path / "images", WIDTH, HEIGHT, [depths] * 2)
    result = track(images, block, tmp_path / "run")
    assert result.returncode == NEVER_TRACKED, result.stderr
    assert len(rows(tmp_path / "run")) == 2
    assert all(row["status"] != "tracking" for row in rows(tmp_path / "run"))


def test_a_clock_that_goes_back_gives_stamps_that_advance(block, tmp_path):
    images = tmp_path / "images"
    shutil.copytree(block, images)
    (images / "depth.txt").write_text(
        "5 depth/000000.png\n1 depth/000001.png\n5 depth/000002.png\n")
    result = track(images, block, tmp_path / "run")
    assert result.returncode == 0, result.stderr
    stamps = [float(row["timestamp"]) for row in rows(tmp_path / "run")]
    assert len(stamps) == 3
    assert stamps == sorted(set(stamps))


def test_an_image_of_one_pixel_is_never_tracked(block, tmp_path):
    images = depth_images.write_folder(tmp_path / "images", 1, 1, [[1000]] * 2)
    result = track(images, block, tmp_path / "run")
    assert result.returncode == NEVER_TRACKED, result.stderr


def test_an_image_of_12_megapixels_is_tracked(block, tmp_path):
    (tmp_path / "camera.yaml").write_text(depth_images.camera_info(4096, 3072))
    result = lockbox("simulate", "--model", "rigid_block", "--trajectory",
                     block / "groundtruth.csv", "--frames", 1, "--camera-info",
                     tmp_path / "camera.yaml", "--output", tmp_path / "images")
    assert result.returncode == 0, result.stderr
    result = track(tmp_path / "images", block, tmp_path / "run")
    assert result.returncode == 0, result.stderr


@pytest.mark.parametrize("count", [3, 8, 16, 32])
def test_few_file_descriptors_suffice_or_are_told(count, block, tmp_path):
    result = track(block, block, tmp_path / "run", limits=f"-n {count}")
    assert result.returncode == 0 or (result.returncode in (3, 127) and result.stderr), result


@pytest.mark.parametrize("megabytes", [20, 60, 100, 200, 400])
def test_too_little_memory_is_told(megabytes, block, tmp_path):
    result = track(block, block, tmp_path / "run", limits=f"-v {1024 * megabytes}")
    assert result.returncode == 0 or (result.returncode in (3, 127) and result.stderr), result


SPECIAL_FILES = [
    ("simulate", "--scene"), ("simulate", "--deviation"), ("simulate", "--sensor"),
    ("simulate", "--camera-info"), ("simulate", "--trajectory"), ("track", "--config"),
    ("track", "--initial-state"), ("track", "--camera-info"), ("track", "--sensor"),
    ("track", "--model"), ("track", "--source"), ("evaluate", "--estimate"),
    ("evaluate", "--reference"),
]


def _with(command, option, file, block, folder):
    """A command that would succeed but for that file."""
    arguments = {
        "simulate": {"--model": "rigid_block", "--trajectory": "auto", "--frames": 1},
        "track": {"--model": "rigid_block", "--source": block,
                  "--initial-state": block / "groundtruth.csv"},
        "evaluate": {"--estimate": block / "groundtruth.csv",
                     "--reference": block / "groundtruth.csv"},
    }[command] | {option: file}
    if command != "evaluate":
        arguments["--output"] = folder / "output"
    return [command, *(word for pair in arguments.items() for word in pair)]


@pytest.mark.parametrize("command, option", SPECIAL_FILES)
def test_what_may_never_end_is_not_read(command, option, block, tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    for file in [pipe, "/dev/zero"]:
        result = lockbox(*_with(command, option, file, block, tmp_path))
        assert result.returncode == 3, result.stderr
        assert str(file) in result.stderr


@pytest.mark.parametrize("name", ["depth.txt", "camera_info.yaml", "0.pcd"])
def test_a_folder_may_hold_pipes(name, block, tmp_path):
    source = tmp_path / "source"
    if name.endswith(".pcd"):
        source.mkdir()
    else:
        shutil.copytree(block, source)
        (source / name).unlink()
    os.mkfifo(source / name)
    result = track(source, block, tmp_path / "run")
    assert result.returncode == 3, result.stderr
    assert name in result.stderr


@pytest.mark.parametrize("option", ["--scene", "--deviation", "--sensor"])
def test_a_text_that_nobody_wrote_is_not_parsed(option, block, tmp_path):
    huge = tmp_path / "huge.yaml"
    with open(huge, "wb") as file:
        file.truncate(10**9)
    result = lockbox(*_with("simulate", option, huge, block, tmp_path), limits="-v 4000000")
    assert result.returncode == 3, result.stderr
    assert "huge.yaml: larger than 4 MB" in result.stderr


def _pipe(file):
    os.mkfifo(file)


def _endless(file):
    file.symlink_to("/dev/zero")


def _long_name(file):
    file.write_text("model: " + 300 * "a")


def _folder_as_model(file):
    file.write_text(f"model: {file.parent}")


@pytest.mark.parametrize("make", [_pipe, _endless, _long_name, _folder_as_model])
def test_a_run_yaml_of_somebody_else_is_left_alone(make, block, tmp_path):
    shutil.copy(block / "groundtruth.csv", tmp_path / "states.csv")
    make(tmp_path / "run.yaml")
    result = lockbox("evaluate", "--estimate", tmp_path / "states.csv", "--reference",
                     block / "groundtruth.csv", limits="-v 4000000")
    assert result.returncode == 0, result.stderr


def test_a_camera_whose_pixels_cannot_be_is_refused(block, tmp_path):
    camera = tmp_path / "camera.yaml"
    camera.write_text((block / "camera_info.yaml").read_text().replace("[144,", "[1e12,"))
    result = lockbox("simulate", "--model", "rigid_block", "--trajectory",
                     block / "groundtruth.csv", "--frames", 1, "--scene", "room", "--sensor",
                     "structured-light", "--camera-info", camera, "--output", tmp_path / "images")
    assert result.returncode == 3, result.stderr
    assert "camera.yaml" in result.stderr
