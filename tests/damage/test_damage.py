# SPDX-License-Identifier: BSD-3-Clause
"""A few damaged files of each kind; scripts/damage tries as many as one wants."""
import dataclasses
import random
import signal

import pytest

import damage
import kinds

COUNT = 2  # of each kind: all of them take some seconds of a processor
SEED = 51


@pytest.fixture(scope="module", name="files")
def _files(tmp_path_factory):
    folder = tmp_path_factory.mktemp("sound")
    kinds.write_sound_files(folder)
    return folder


@pytest.mark.parametrize("kind", kinds.KINDS, ids=lambda kind: kind.name)
def test_is_taken_or_refused_by_name(kind, files):
    statuses, faults = damage.run_kind(kind, files, COUNT, SEED)
    assert not faults, "\n".join(faults)
    assert sum(statuses.values()) == COUNT


@pytest.mark.parametrize("kind", kinds.KINDS, ids=lambda kind: kind.name)
def test_sound_files_are_taken_by_every_command(kind, files, tmp_path):
    """Else mutants would be refused for what is not damaged in them."""
    sound = dataclasses.replace(kind, mutate=lambda data, draw: data)
    for command in kind.commands:
        one = dataclasses.replace(sound, commands=[command])
        assert damage.try_mutant(one, files, tmp_path / "copy", SEED, 0) in kind.allowed


@pytest.mark.parametrize("kind", kinds.KINDS, ids=lambda kind: kind.name)
def test_mutants_differ_and_follow_from_their_seed(kind, files):
    sound = kind.files(files)[0].read_bytes()
    mutants = [kind.mutate(sound, random.Random(number)) for number in range(50)]
    assert mutants == [kind.mutate(sound, random.Random(number)) for number in range(50)]
    assert sum(mutant != sound for mutant in mutants) > 40


@pytest.mark.parametrize("status, said, memory, fault", [
    (-signal.SIGSEGV, "", 0, "SIGSEGV"),
    (-signal.SIGXCPU, "", 0, "processor"),
    (70, "", 0, "exit 70"),
    (2, "", 0, "exit 2"),
    (3, "something is wrong", 0, "without the name"),
    (0, "", damage.BYTES + 1, "memory"),
])
def test_faults_are_seen(status, said, memory, fault):
    with pytest.raises(damage.Fault, match=fault):
        damage.check(status, said, memory, (0, 1, 5), ["name.oni"])


def test_a_refusal_by_name_is_no_fault():
    damage.check(3, "lockbox: /tmp/name.oni: is damaged", 0, (0,), ["name.oni"])
