# SPDX-License-Identifier: BSD-3-Clause
"""What tools read about the package: stubs and docstrings."""

import ast
import inspect
import os
import pathlib
import subprocess
import sys

import lockbox

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
