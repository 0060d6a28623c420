# SPDX-License-Identifier: BSD-3-Clause
"""Tracking from a source, and from arrays."""

import copy
import csv
import os
import pickle
import shutil
import signal
import threading
import time

import numpy as np
import pytest

import lockbox


@pytest.fixture(scope="module")
def model():
    return lockbox.load_model("rigid_block")


@pytest.fixture(scope="module")
def frames(recording):
    return list(lockbox.open_source(recording))


@pytest.fixture(scope="module")
def truth(recording):
    with open(recording / "groundtruth.csv") as file:
        return list(csv.DictReader(file))


# Half a turn about x: what is in front of the cabinet (its z) is towards the camera.
FRONT = np.array([[1.0, 0, 0, 0], [0, -1, 0, 0], [0, 0, -1, 1.2], [0, 0, 0, 1]])


def position(row):
    return np.array([float(row[name]) for name in ("tx", "ty", "tz")])


def start_of(row):
    x, y, z, w = (float(row[name]) for name in ("qx", "qy", "qz", "qw"))
    base = np.eye(4)
    base[:3, 3] = position(row)
    base[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    return lockbox.State(base)


def test_source_delivers_its_frames(recording, frames):
    source = lockbox.open_source(recording)
    assert source.frame_count == len(frames) == 30
    assert "depth images" in source.description
    frame = frames[3]
    assert frame.index == 3 and frame.time == pytest.approx(0.1)
    assert frame.depth.dtype == np.uint16 and frame.depth.shape == (120, 160)
    np.testing.assert_allclose(frame.metres, frame.depth * frame.metres_per_unit, rtol=1e-6)
    assert frame.intrinsics[0, 0] == 142 and frame.intrinsics[0, 2] == 79.5
    with pytest.raises(StopIteration):
        for _ in range(31):
            next(source)


def test_source_is_taken_once_and_can_be_closed(recording):
    source = lockbox.open_source(recording)
    assert len(list(source)) == 30
    with pytest.raises(StopIteration):
        next(source)
    with pytest.raises(lockbox.InputError, match="opens it anew"):
        iter(source)
    with lockbox.open_source(recording) as source:
        assert next(source).index == 0
    assert source.frame_count == 30 and "depth images" in source.description
    with pytest.raises(lockbox.InputError, match="was closed"):
        next(source)
    source.close()


def test_frames_units_and_metres_give_the_same_and_the_truth(model, frames, truth):
    start = start_of(truth[0])
    K = frames[0].intrinsics
    trackers = [lockbox.Tracker(model, initial_state=start),
                lockbox.Tracker(model, K, initial_state=start),
                lockbox.Tracker(model, K, initial_state=start)]
    for frame, row in list(zip(frames, truth))[:10]:
        millimetres = np.round(1000 * frame.metres).astype(np.uint16)
        metres = np.where(millimetres > 0, millimetres / 1000.0, np.nan)
        results = [trackers[0].track(frame), trackers[1].track(millimetres, frame.time),
                   trackers[2].track(metres, frame.time)]
        for result in results:
            assert np.linalg.norm(result.base[:3, 3] - position(row)) < 0.01
            np.testing.assert_allclose(result.base, results[0].base, atol=1e-3)
        assert results[0].time == frame.time
    result = results[0]
    assert result.status in ("tracking", "uncertain")
    assert result.joints == result.sigma == {}
    assert result.reason is None
    assert trackers[2].track(metres.tolist()).status == result.status
    for twin in (copy.deepcopy(result), pickle.loads(pickle.dumps(result))):
        np.testing.assert_array_equal(twin.covariance, result.covariance)
        np.testing.assert_array_equal(twin.state.base, result.base)
        assert (twin.status, twin.time, twin.sigma) == (result.status, result.time, result.sigma)
    assert result.covariance.shape == (6, 6) and np.all(np.diag(result.covariance) > 0)
    assert 0 < result.seconds < 10
    assert 0 <= result.contradicted <= result.explained <= 1
    assert trackers[0].initial_state.base[2, 3] == start.base[2, 3]
    assert trackers[0].model.name == model.name


def test_joints_have_one_order():
    model = lockbox.load_model("cabinet")
    assert model.variables == [joint.name for joint in model.joints if not joint.is_mimic]
    start = lockbox.State(FRONT, {"drawer": 0.1, "door": 0.6})
    K = [[285, 0, 159.5], [0, 285, 119.5], [0, 0, 1]]
    depth, _ = model.render(start, K, (240, 320))
    result = lockbox.Tracker(model, K, initial_state=start).track(depth)
    names = [joint.name for joint in model.joints]
    assert list(result.joints) == list(result.sigma) == list(result.state.joints) == names
    sigma = dict(zip(model.variables, np.sqrt(np.diag(result.covariance)[6:])))
    known = [name for name in names if np.isfinite(result.sigma[name])]
    assert {"drawer", "door"} <= set(known)
    assert sigma["drawer"] != pytest.approx(sigma["door"], rel=1e-3)
    for name in known:
        assert sigma[name] == pytest.approx(result.sigma[name]), name


def test_images_of_a_frame_cannot_be_changed_in_place(model, frames, truth):
    for image in (frames[0].depth, frames[0].metres):
        with pytest.raises(ValueError, match="read-only"):
            image[:] = 0
    depth = frames[0].depth.copy()
    depth[:10] = 0
    tracker = lockbox.Tracker(model, frames[0].intrinsics, initial_state=start_of(truth[0]))
    assert tracker.track(depth, time=frames[0].time).time == frames[0].time


def test_without_a_start_it_is_found_and_reset_begins_anew(model, frames, truth):
    tracker = lockbox.Tracker(model, frames[0].intrinsics)
    first = tracker.track(frames[0].depth)
    again = tracker.track(frames[1].depth)
    assert again.time == pytest.approx(1 / 30) and tracker.initial_state is None
    tracker.reset(start_of(truth[0]))
    assert tracker.track(frames[0].depth).time == 0
    assert tracker.initial_state is not None
    assert first.status in ("tracking", "uncertain", "initializing")


def test_apparent_size_tells_a_model_that_is_too_small(frames, truth):
    for scale in (1.0, 0.93):
        model = lockbox.load_model("rigid_block", mesh_scale=scale)
        tracker = lockbox.Tracker(model, initial_state=start_of(truth[0]))
        for frame in frames[:12]:
            result = tracker.track(frame)
        size = result.apparent_size
        assert size.across == pytest.approx(1 / scale, abs=0.02)
        assert 0 < size.across_sigma < 0.05 and size.along_sigma > 0
        assert size.is_implausible == (scale != 1.0)
        assert pickle.loads(pickle.dumps(result)).apparent_size.across == size.across


def test_noise_is_found_out_where_no_sensor_is_named(model, truth):
    """A camera of 320 x 240 whose pixels err by 5.5 mm at a metre, the block before a wall."""
    intrinsics = np.array([[288.0, 0, 159.5], [0, 288.0, 119.5], [0, 0, 1]])
    start = start_of(truth[0])
    depth, _ = model.render(start, intrinsics, (240, 320))
    metres = np.where(depth > 0, depth, depth.max() + 0.5)
    random = np.random.default_rng(1)
    residuals = {}
    for sensor in ("auto", "primesense"):
        tracker = lockbox.Tracker(model, intrinsics, initial_state=start, sensor=sensor)
        residuals[sensor] = [tracker.track(metres + 0.0055 * metres**2 * random.standard_normal(metres.shape)).residual_rms
                             for _ in range(3)][-1]
    assert 0.8 < residuals["auto"] < 1.25
    assert residuals["primesense"] > 1.5


def test_nothing_known_is_nan(model, frames):
    tracker = lockbox.Tracker(model, frames[0].intrinsics)
    result = tracker.track(np.zeros((120, 160), np.uint16))
    assert result.status == "initializing"
    assert np.isnan(result.base[:3]).all() and np.isnan(result.covariance).all()
    assert result.reason.startswith("No pixel has a depth")


@pytest.mark.parametrize("depth, text", [
    (np.zeros((120, 160), np.int64), "array of int64; uint16"),
    (np.zeros((120, 160, 3), np.uint16), "rows x columns"),
    (np.zeros((0, 160), np.float32), "rows x columns"),
])
def test_what_is_no_depth_image_is_refused(model, frames, depth, text):
    with pytest.raises(lockbox.InputError, match=text):
        lockbox.Tracker(model, frames[0].intrinsics).track(depth)


def test_wrong_arguments_are_refused(model, frames, recording):
    with pytest.raises(lockbox.InputError, match="are needed for arrays"):
        lockbox.Tracker(model).track(frames[0].depth)
    tracker = lockbox.Tracker(model, initial_state=lockbox.State(np.eye(4)))
    tracker.track(frames[0])
    with pytest.raises(lockbox.InputError, match="not later"):
        tracker.track(frames[0])
    for time_ in (np.nan, np.inf):
        with pytest.raises(lockbox.InputError, match="time"):
            lockbox.Tracker(model, frames[0].intrinsics).track(frames[0].depth, time_)
    with pytest.raises(lockbox.InputError, match="lid"):
        lockbox.Tracker(model, locked_joints=["lid"])
    with pytest.raises(lockbox.InputError, match="kinectt"):
        lockbox.Tracker(model, sensor="kinectt")
    far = np.eye(4)
    far[2, 3] = 1250.0
    with pytest.raises(lockbox.InputError, match="millimetres"):
        lockbox.Tracker(model, initial_state=lockbox.State(far))
    with pytest.raises(lockbox.InputError, match="none.oni"):
        lockbox.open_source("none.oni")


def test_waiting_for_a_frame_ends_at_ctrl_c(recording, tmp_path):
    shutil.copytree(recording, tmp_path / "gap")
    (tmp_path / "gap" / "depth.txt").write_text(
        "0 depth/000000.png\n3600 depth/000001.png\n")
    source = lockbox.open_source(tmp_path / "gap", realtime=True)
    next(source)
    signals = []

    def press_ctrl_c():
        time.sleep(0.2)
        signals.append(time.monotonic())
        os.kill(os.getpid(), signal.SIGINT)

    thread = threading.Thread(target=press_ctrl_c)
    thread.start()
    with pytest.raises(KeyboardInterrupt):
        next(source)
        time.sleep(10)
    assert time.monotonic() - signals[0] < 3  # a second, on a machine that is not busy
    thread.join()


def test_searches_in_the_background_do_not_hold_frames(frames):
    tracker = lockbox.Tracker(lockbox.load_model("cabinet"), frames[0].intrinsics,
                              background_search=True)
    begin = time.monotonic()
    for frame in frames[:3]:
        assert tracker.track(frame.depth).status == "initializing"
    assert time.monotonic() - begin < 5, "the search takes longer"


def test_search_lets_other_threads_go_on_and_ends_at_ctrl_c(frames):
    """Another model than the frame shows is sought for a long time."""
    tracker = lockbox.Tracker(lockbox.load_model("cabinet"), frames[0].intrinsics)
    steps = []
    ended = threading.Event()

    def press_ctrl_c():
        while len(steps) < 30:
            steps.append(time.monotonic())
            time.sleep(0.01)
        os.kill(os.getpid(), signal.SIGINT)
        steps.append(time.monotonic())
        ended.set()

    thread = threading.Thread(target=press_ctrl_c)
    thread.start()
    returned = False
    with pytest.raises(KeyboardInterrupt):
        tracker.track(frames[0].depth)
        returned = True
        ended.wait()
    late = time.monotonic() - steps[-1]
    thread.join()
    assert not returned, "the thread that presses has waited for the search"
    assert late < 3  # a second, on a machine that is not busy
    tracker.reset(lockbox.State(np.eye(4)))
