# SPDX-License-Identifier: BSD-3-Clause
"""Models: what is in them, their distances, and how they look."""

import copy
import pickle

import numpy as np
import pytest

import lockbox

K = np.array([[142, 0, 79.5], [0, 142, 59.5], [0, 0, 1.0]])

BOX = """<robot name="box"><link name="base"><visual><geometry><box size="0.2 0.1 0.4"/></geometry>
</visual></link></robot>"""


@pytest.fixture(scope="module")
def box(tmp_path_factory):
    file = tmp_path_factory.mktemp("box") / "box.urdf"
    file.write_text(BOX)
    return lockbox.load_model(file)


def pose(z, x=0.0):
    base = np.eye(4)
    base[:3, 3] = x, 0, z
    return base


def test_shipped_model_has_the_joints_of_its_urdf():
    model = lockbox.load_model("cabinet")
    assert model.name == "cabinet"
    assert {joint.name: joint.type for joint in model.joints} == {
        "door": "revolute", "drawer": "prismatic", "inner_drawer": "prismatic",
        "knob": "revolute"}
    assert len(model.bodies) == 5
    drawer = next(joint for joint in model.joints if joint.name == "drawer")
    assert drawer.lower == 0 and 0.1 < drawer.upper < 1 and not drawer.is_mimic


def test_joints_of_a_state_cannot_be_changed_in_place():
    model = lockbox.load_model("cabinet")
    state = model.rest_state
    assert list(state.joints) == [joint.name for joint in model.joints]
    with pytest.raises(TypeError):
        state.joints["door"] = 1.0
    state.joints = {**state.joints, "door": 1.0}
    assert state.joints["door"] == 1.0 and state.joints["drawer"] == 0
    assert lockbox.State(state.base, state.joints).joints == state.joints
    with pytest.raises(TypeError):
        state.joints = {1: 1.0}
    with pytest.raises(ValueError, match="wide"):
        state.joints = {"door": "wide"}


def test_states_are_checked_at_once(box):
    moved = pose(1.0, x=0.3)
    for base, text in [(2 * np.eye(4), "not a pose"), (np.full((4, 4), np.nan), "not a pose"),
                       (moved.T, "is it transposed")]:
        with pytest.raises(lockbox.InputError, match=text):
            lockbox.State(base)
        with pytest.raises(lockbox.InputError, match=text):
            box.rest_state.base = base
    with pytest.raises(lockbox.InputError, match="'door'|\"door\""):
        lockbox.State(moved, {"door": np.nan})


def test_states_can_be_copied_and_pickled():
    state = lockbox.State(pose(1.0), {"drawer": 0.1, "door": 0.5})
    for twin in (copy.deepcopy(state), pickle.loads(pickle.dumps(state))):
        np.testing.assert_array_equal(twin.base, state.base)
        assert list(twin.joints.items()) == list(state.joints.items())


def test_matrices_of_other_images_are_refused(box):
    state = lockbox.State(pose(1.0))
    for matrix, text in [(np.diag([1, 1, 1.0]), "fx is 1 pixels.*multiply it"),
                         ([[142, 0, 79.5], [0, 142, 1000], [0, 0, 1]], "cy is 1000, far outside")]:
        with pytest.raises(lockbox.InputError, match=text):
            box.render(state, matrix, (120, 160))


def test_distances_are_those_to_the_surface(box):
    points = np.array([[0, 0, 0], [0, 0.05, 0], [0, 0.25, 0], [0.3, 0, 0]])
    np.testing.assert_allclose(box.signed_distance("base", points), [-0.05, 0, 0.2, 0.2],
                               atol=0.002)
    distances, gradients = box.signed_distance_and_gradient("base", points[2:])
    np.testing.assert_allclose(gradients, [[0, 1, 0], [1, 0, 0]], atol=0.02)
    assert distances.dtype == np.float32 and gradients.shape == (2, 3)
    assert box.signed_distance("base", np.empty((0, 3))).shape == (0,)


def test_rendered_depth_is_that_of_the_front(box):
    depth, body = box.render(lockbox.State(pose(1.2)), K, (120, 160))
    assert depth.shape == body.shape == (120, 160)
    assert depth[60, 80] == pytest.approx(1.0)
    assert body[60, 80] == 0
    assert depth[0, 0] == 0 and body[0, 0] == -1
    seen = np.argwhere(body == 0)
    assert seen[:, 1].max() - seen[:, 1].min() + 1 == pytest.approx(0.2 * 142, abs=1)


def test_poses_of_bodies_follow_the_joints():
    model = lockbox.load_model("cabinet")
    rest = model.rest_state
    rest.base = pose(1.25)
    moved = lockbox.State(rest.base, {"drawer": 0.1})
    before, after = model.body_poses(rest), model.body_poses(moved)
    shifts = {name: np.linalg.norm(after[name][:3, 3] - before[name][:3, 3]) for name in before}
    assert sorted(shifts) == sorted(model.bodies)
    assert max(shifts.values()) == pytest.approx(0.1)
    assert shifts[model.bodies[0]] == 0


def test_errors_have_the_text_of_the_tool(box, tmp_path):
    assert issubclass(lockbox.InputError, ValueError)
    with pytest.raises(lockbox.InputError, match="there is no such file; give a file, or one of"):
        lockbox.load_model("cabinett")
    with pytest.raises(lockbox.InputError, match="no body of the model; it has base"):
        box.signed_distance("lid", np.zeros((1, 3)))
    with pytest.raises(lockbox.InputError, match="N x 3"):
        box.signed_distance("base", np.zeros((3, 2)))
    with pytest.raises(lockbox.InputError, match="is not a pose"):
        box.render(lockbox.State(2 * np.eye(4)), K, (120, 160))
    with pytest.raises(lockbox.InputError, match="camera matrix"):
        box.render(lockbox.State(pose(1)), np.zeros((3, 3)), (120, 160))
    with pytest.raises(lockbox.InputError, match="shape"):
        box.render(lockbox.State(pose(1)), K, (1 << 30, 1 << 30))
    with pytest.raises(lockbox.InputError, match="lid"):
        box.body_poses(lockbox.State(pose(1), {"lid": 0.1}))
    with pytest.raises(OSError, match="too long"):
        lockbox.load_model("x" * 5000)
    file = tmp_path / "bad.urdf"
    file.write_text(BOX.replace("0.2 0.1 0.4", "0.2 0.1"))
    with pytest.raises(lockbox.InputError, match="bad.urdf:1"):
        lockbox.load_model(str(file))


def test_warnings_are_those_of_python(tmp_path):
    file = tmp_path / "small.urdf"
    file.write_text(BOX.replace("0.2 0.1 0.4", "0.004 0.001 0.001"))
    with pytest.warns(UserWarning, match="base"):
        lockbox.load_model(file)
