# SPDX-License-Identifier: BSD-3-Clause
"""Commands and examples of all documents. Each command that stands in one is known to the tool, with its
options; those that measure for long run here in small versions."""

import os
import pathlib
import re
import shlex
import subprocess

import pytest

from conftest import CAMERA
from document import code_blocks

ROOT = pathlib.Path(__file__).parents[2]
BUILD = pathlib.Path(os.environ["LOCKBOX_BUILD"])
DOCUMENTS = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
SMALL_CAMERA = "--camera-info camera.yaml"


def commands(document):
    """Lines of the blocks without a language or of sh, without comments; continued ones are joined."""
    text = "".join(code_blocks(document, "") + code_blocks(document, "sh"))
    lines = text.replace("\\\n", " ").splitlines()
    return [" ".join(line.split(" #")[0].split()) for line in lines]


def told_commands(document):
    """Also those within sentences, as lists of words."""
    inline = re.findall(r"`(lockbox [a-z][^`]*|(?:simulate|track|record|view) -[^`]*)`",
                        document.read_text())
    for command in commands(document) + inline:
        command = command.split("|")[0]
        if re.match(r"(build/bin/)?lockbox [a-z]", command) or command in inline:
            words = shlex.split(command)
            yield words[1:] if words[0].endswith("lockbox") else words


@pytest.fixture(scope="session")
def help_of(tool):
    pages = {}

    def page(command):
        if command not in pages:
            pages[command] = subprocess.run([tool, *command, "--help"], capture_output=True,
                                            text=True)
        return pages[command]
    return page


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda path: path.name)
def test_commands_and_their_options_are_known(document, help_of):
    for words in told_commands(document):
        is_of_experiment = words[0] == "experiment" and len(words) > 1 and words[1].islower()
        command = tuple(words[:2] if is_of_experiment else words[:1])
        page = help_of(command)
        assert page.returncode == 0, words
        known = page.stdout + (help_of(command[:1]).stdout if is_of_experiment else "")
        for option in (word.split("=")[0] for word in words[1:] if word.startswith("-")):
            assert re.search(rf"(?<![\w-]){option}(?![\w-])", known), (option, words)


PLACEHOLDERS = {"N": "2000", "NAME": "rigid"}


@pytest.mark.parametrize("document", ["README.md", "docs/benchmarks.md", "docs/experiments.md",
                                      "docs/experiments-objects.md"])
def test_experiments_are_taken_as_they_stand(document, tool, tmp_path):
    """With --help behind them the program reads and judges every value, and runs nothing."""
    count = 0
    for words in told_commands(ROOT / document):
        if words[0] != "experiment":
            continue
        words = [PLACEHOLDERS.get(word, word) for word in words]
        if "--rows" in words:  # what an experiment before it has written
            rows = tmp_path / words[words.index("--rows") + 1]
            rows.parent.mkdir(parents=True)
            rows.touch()
        parsed = subprocess.run([tool, *words, "--help"], cwd=tmp_path, capture_output=True, text=True)
        assert parsed.returncode == 0, (words, parsed.stderr)
        count += 1
    assert count > 0


def test_a_value_that_is_wrong_would_be_noticed(tool):
    for words in (["experiment", "peers", "--trials", "x"], ["experiment", "mismatch", "--kind", "any"]):
        parsed = subprocess.run([tool, *words, "--help"], capture_output=True, text=True)
        assert parsed.returncode == 2, words


def run(command, folder, environment):
    ran = subprocess.run(["bash", "-c", command], cwd=folder, env=environment, capture_output=True,
                         text=True)
    assert ran.returncode == 0, command + "\n" + ran.stdout + ran.stderr
    return ran.stdout


@pytest.fixture
def folder(tmp_path, tool):
    """Where the commands of measurements are given: the root of the sources, with results apart."""
    (tmp_path / "camera.yaml").write_text(CAMERA)
    for name in ("scripts", "share", "tests"):
        (tmp_path / name).symlink_to(ROOT / name)
    (tmp_path / "build").symlink_to(BUILD)
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin" / "lockbox").symlink_to(tool)
    return tmp_path


@pytest.fixture
def environment(folder):
    return {**os.environ, "PATH": f"{folder / 'bin'}:{os.environ['PATH']}"}


# What makes the commands of a document small: what stands there, and what is said instead.
SMALL = {
    "benchmarks.md": [
        ("--model lockbox --trajectory auto --scene room --frames 240",
         f"--model rigid_block --trajectory auto --scene room --frames 6 {SMALL_CAMERA}"),
        ("track --model lockbox", "track --model rigid_block"),
        ("--frames 60", "--frames 6"),
        ("-budget N", "-budget 2000"), ("run_N", "run_2000"),
        ("--fast-points N", "--fast-points 2000 --seeds 1 --frames 3"),
        ("share/models/lockbox/lockbox.urdf room 20", "share/models/rigid_block/rigid_block.urdf room 1"),
        ("out/session 600", "out/session 5"),
        ("--benchmark_repetitions=5", "--benchmark_list_tests"),
    ],
    "experiments.md": [
        ("convergence --samples 1 --step 15", "convergence --model rigid_block --samples 1 --step 45 "
         "--frames 12 --joints free"),
        ("kidnap --runs 4 --live-runs 4", "kidnap --model rigid_block --runs 1 --live-runs 1"),
        ("speed --runs 4 --frames 120 --fastest 16",
         "speed --model rigid_block --runs 1 --frames 8 --fastest 2"),
    ],
    "experiments-objects.md": [("--pieces 4", "--pieces 1")],
}


def small(document, command):
    for long, short in SMALL[document]:
        command = command.replace(long, short)
    return command


@pytest.mark.parametrize("document", SMALL)
def test_measurements_run_in_small_versions(docs, document, folder, environment):
    count = 0
    for command in commands(docs / document):
        if not command or command.startswith("cmake"):
            continue  # built already
        program = re.search(r"build/tests/benchmarks/\w+", command)
        if program and not (BUILD / program[0].removeprefix("build/")).exists():
            continue  # its library is not installed
        run(small(document, command), folder, environment)
        count += 1
    assert count >= 3


def test_damage_runs(docs, tool, tmp_path):
    """What the script starts after it has built."""
    program = ROOT / "tests" / "damage" / "damage.py"
    assert "tests/damage/damage.py" in (ROOT / "scripts" / "damage").read_text()
    for command in (command for command in commands(docs / "reliability.md") if "damage" in command):
        script, *options = command.split()
        assert os.access(ROOT / script, os.X_OK)
        options = [word.replace("2000", "1") for word in options] or ["--count", "1", "--kinds", "states"]
        run(f"/usr/bin/python3 -B {program} {' '.join(options)}", tmp_path,
            {**os.environ, "LOCKBOX_TOOL": tool})


def test_targets_of_fuzzing_are_there(docs):
    whole, some = (command for command in commands(docs / "reliability.md") if "fuzz" in command)
    script, seconds, *targets = some.split()
    assert os.access(ROOT / script, os.X_OK) and whole == script and int(seconds) > 0
    for target in targets:
        assert (ROOT / "tests" / "fuzz" / f"{target}.cpp").exists(), target


def test_profile_of_ones_own_is_taken(docs, tool, recording, tmp_path):
    text = (docs / "sensors.md").read_text()
    (profile,) = code_blocks(docs / "sensors.md", "yaml")
    (tmp_path / "d415.yaml").write_text(profile)
    described = subprocess.run(
        [tool, "track", "--model", "rigid_block", "--source", recording, "--sensor", "d415.yaml",
         "--output", "run"], cwd=tmp_path, capture_output=True, text=True)
    assert described.returncode == 0, described.stderr
    assert "d415.yaml" in (tmp_path / "run" / "run.yaml").read_text()
    table = re.findall(r"^\| `([a-z0-9-]+)`(?:, `([a-z0-9-]+)`)*", text, re.MULTILINE)
    assert table


def test_table_of_what_a_profile_gains_is_made(docs, tool, tmp_path):
    (command,) = (command for command in commands(docs / "sensors.md") if "profiles.py" in command)
    program = command.split()[0]
    printed = run(f"/usr/bin/python3 -B {ROOT / program} {tool} out white --model rigid_block --frames 3", tmp_path, None)
    assert re.fullmatch(r"\| rigid_block \| `white` (\| 3; .*; .*; .* ){3}\|\n", printed)


def test_table_of_cameras_that_come_near_is_made(docs, tool, tmp_path):
    (command,) = (command for command in commands(docs / "sensors.md") if "approach.py" in command)
    program = command.split()[0]
    printed = run(f"/usr/bin/python3 -B {ROOT / program} {tool} out ideal --frames 20", tmp_path, None)
    assert re.fullmatch(r"\| `ideal` \| .*; .*; .* % \| .*; .*; .* % \|\n", printed)


def test_scripts_that_are_named_are_there():
    named = {script for document in [*DOCUMENTS, ROOT / "CONTRIBUTING.md"]
             for script in re.findall(r"`(scripts/\w+|\.ci/run)", document.read_text())}
    assert {"scripts/build", "scripts/test", "scripts/format"} <= named
    for script in named:
        assert os.access(ROOT / script, os.X_OK), script


def test_options_of_the_file_example_are_known(docs, help_of):
    block = next(block for block in code_blocks(docs / "run-files.md", "") if "iterations" in block)
    page = help_of(("track",)).stdout
    for name in re.findall(r"^([a-z-]+) =", block, re.MULTILINE):
        assert f"--{name}" in page, name
