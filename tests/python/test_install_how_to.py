# SPDX-License-Identifier: BSD-3-Clause
"""The commands of docs/how-to/install.md, as they stand there, on what is built already."""

import os
import pathlib
import re
import subprocess

import pytest

from document import code_blocks

SOURCES = pathlib.Path(__file__).parents[2]
BUILD = pathlib.Path(os.environ["LOCKBOX_BUILD"])
PROGRAM = SOURCES / "tests" / "packaging" / "pkg_config" / "main.cpp"


def commands(document):
    """Lines, without comments."""
    text = "".join(code_blocks(document, "sh"))
    return [line.split("  #")[0].strip() for line in text.splitlines() if line]


def is_of_the_machine(command):
    """Whether it builds anew, or installs for everybody."""
    return command.startswith(("scripts/", "apt-get"))


@pytest.fixture
def document(docs):
    return docs / "how-to" / "install.md"


def test_commands_run(document, tmp_path):
    (tmp_path / "build").symlink_to(BUILD)
    (tmp_path / "main.cpp").symlink_to(PROGRAM)
    script = [command for command in commands(document) if not is_of_the_machine(command)]
    script += ["complete -p lockbox", './program "$PREFIX"/share/lockbox/models/*/rigid_block.urdf']
    result = subprocess.run(
        ["bash", "-e", "-u", "-c", "\n".join(script)], cwd=tmp_path, capture_output=True, text=True,
        env={**os.environ, "PREFIX": str(tmp_path / "prefix")})
    assert result.returncode == 0, result.stdout + result.stderr
    assert re.search(r"^lockbox \d+\.\d+\.\d+$", result.stdout, re.MULTILINE)
    assert "complete -F" in result.stdout
    assert "rigid_block: 0 joint variables" in result.stdout


def test_scripts_are_there(document):
    scripts = [command.split()[0] for command in commands(document)
               if command.startswith("scripts/")]
    assert scripts == ["scripts/setup", "scripts/build", "scripts/package"]
    for script in scripts:
        assert os.access(SOURCES / script, os.X_OK)


def test_packages_have_the_names_of_the_table(document):
    configuration = (BUILD / "CPackConfig.cmake").read_text()
    names = re.findall(r'set\(CPACK_DEBIAN_\w+_PACKAGE_NAME "(.*)"\)', configuration)
    table = re.search(r"\| package \| holds \|\n(.*?)\n\n", document.read_text(), re.DOTALL)[1]
    assert sorted(names) == sorted(re.findall(r"^\| `([^`]+)`", table, re.MULTILINE))
