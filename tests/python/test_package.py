# SPDX-License-Identifier: BSD-3-Clause
"""What tools read about the package: stubs and docstrings."""

import ast
import inspect
import os
import pathlib
import subprocess
import sys

import pytest

import lockbox
from document import code_blocks

FOLDER = pathlib.Path(lockbox.__file__).parent


def stub_names():
    """Names of the stub file: functions, and classes with their public members."""
    functions, classes = set(), {}
    for node in ast.parse((FOLDER / "__init__.pyi").read_text()).body:
        if isinstance(node, ast.FunctionDef):
            functions.add(node.name)
        elif isinstance(node, ast.ClassDef):
            members = {item.name for item in node.body if isinstance(item, ast.FunctionDef)}
            members |= {item.target.id for item in node.body if isinstance(item, ast.AnnAssign)}
            classes[node.name] = {name for name in members if not name.startswith("_")}
    return functions, classes


def public(names):
    return {name for name in names if not name.startswith("_")}


def test_package_is_the_one_under_test():
    assert FOLDER == pathlib.Path(os.environ["LOCKBOX_PACKAGE"]).resolve() / "lockbox"
    assert (FOLDER / "py.typed").exists()


def test_version_is_that_of_the_tool():
    tool = subprocess.run([os.environ["LOCKBOX_TOOL"], "--version"], capture_output=True, text=True)
    assert tool.stdout.split() == ["lockbox", lockbox.__version__]


def test_missing_numpy_is_said_at_the_import():
    code = "import sys; sys.modules['numpy'] = None; import lockbox"
    result = subprocess.run([sys.executable, "-B", "-c", code], capture_output=True, text=True)
    assert result.returncode != 0 and "numpy" in result.stderr.splitlines()[-1]


def test_stubs_agree_with_the_package():
    functions, classes = stub_names()
    assert functions | set(classes) == set(lockbox.__all__)
    for name, members in classes.items():
        own = getattr(lockbox, name)
        inherited = public(dir(ValueError)) | public(dir(RuntimeError))
        assert members == public(dir(own)) - inherited, name


def test_arguments_of_the_stubs_are_those_of_the_docstrings():
    for node in ast.walk(ast.parse((FOLDER / "__init__.pyi").read_text())):
        if isinstance(node, ast.FunctionDef) and node.name in lockbox.__all__:
            signature = getattr(lockbox, node.name).__doc__.splitlines()[0]
            for argument in node.args.args:
                assert argument.arg + ":" in signature, node.name


def test_everything_is_explained_in_sentences():
    for name in lockbox.__all__:
        item = getattr(lockbox, name)
        members = [item] if not inspect.isclass(item) else [item] + [
            getattr(item, member) for member in public(vars(item))]
        for member in members:
            assert member.__doc__ and member.__doc__.rstrip().endswith("."), (name, member)


USE = '''
import numpy as np
from numpy.typing import NDArray
import lockbox

model = lockbox.load_model("cabinet")
state = model.rest_state
state.joints = {"door": 0.5}
depth, body = model.render(state, np.eye(3), (48, 64))
distances: NDArray[np.float32] = model.signed_distance(model.bodies[0], np.zeros((4, 3)))
tracker = lockbox.Tracker(model, np.eye(3), initial_state=state, locked_joints=["door"])
for frame in lockbox.open_source("openni2:", mode="320x240@60"):
    result = tracker.track(frame)
    sigma: float = result.sigma["door"]
    other = tracker.track(frame.depth, time=frame.time)
    base: NDArray[np.float64] = other.alternatives[0].state.base
summary = lockbox.evaluate("run/states.csv", "groundtruth.csv")
'''


def mypy(folder, *files):
    """What it says of the files, checked with nothing left open."""
    pytest.importorskip("mypy", reason="Debian's package mypy is not installed")
    return subprocess.run([sys.executable, "-B", "-m", "mypy", "--strict", "--cache-dir",
                           folder / "cache", *files], capture_output=True, text=True)


def test_type_checker_takes_the_stubs_and_programs_that_use_them(tmp_path, docs):
    files = [FOLDER / "__init__.pyi"]
    for number, block in enumerate([USE] + code_blocks(docs / "python.md", "python")):
        files.append(tmp_path / f"block{number}.py")
        files[-1].write_text(block)
    checked = mypy(tmp_path, *files)
    assert checked.returncode == 0, checked.stdout + checked.stderr


def test_type_checker_finds_wrong_uses(tmp_path):
    wrong = ["lockbox.load_model(3)", "model.render(state, np.eye(3))",
             'lockbox.open_source("a.oni", mode=60)', "tracker.track()", "model.joint",
             'result.sigma = {}']
    files = []
    for number, line in enumerate(wrong):
        files.append(tmp_path / f"wrong{number}.py")
        files[-1].write_text(USE + line + "\n")
    checked = mypy(tmp_path, *files)
    for number, line in enumerate(wrong):
        assert f"wrong{number}.py:{len(USE.splitlines()) + 1}: error:" in checked.stdout, line
