#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the lockbox tool on damaged files: it takes them or refuses them, and nothing else happens.

Each mutant follows from seed, kind and number alone, so that one can be made again. A mutant that
is a fault is kept, with what the tool said.
"""
import argparse
import collections
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import kinds

REFUSED = 3
SECONDS = 60  # of a processor, for files of a few hundred kilobytes; the slowest sound one takes 2
WAIT = 600  # seconds by the clock: the machine may be busy with other things
# A model's fields may take 2 GB; reading and building them takes as much again.
BYTES = 4 << 30


class Fault(Exception):
    """What the tool must not do."""


def _limited(command, environment):
    """Runs the command; returns exit status (-signal), what it said, and its peak memory, bytes."""
    limits = f"ulimit -t {SECONDS} -c 0 && exec \"$@\""
    with tempfile.TemporaryFile() as said:
        process = subprocess.Popen(["bash", "-c", limits, "limited", *command], stdout=said,
                                   stderr=said, stdin=subprocess.DEVNULL,
                                   env={**os.environ, **environment}, start_new_session=True)
        end = time.monotonic() + WAIT
        pid = 0
        while pid == 0 and time.monotonic() < end:
            pid, status, usage = os.wait4(process.pid, os.WNOHANG)
            time.sleep(0.01)
        if pid == 0:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()
            raise Fault(f"hangs: not done after {WAIT} s")
        process.returncode = os.waitstatus_to_exitcode(status)
        said.seek(0)
        return process.returncode, said.read().decode(errors="replace"), usage.ru_maxrss * 1024


def check(status, said, memory, allowed, names):
    """Raises Fault unless the file was taken, or refused by one of its names."""
    if status == -signal.SIGXCPU or status == -signal.SIGKILL:
        raise Fault(f"takes more than {SECONDS} s of a processor")
    if status < 0:
        raise Fault(f"ended by {signal.Signals(-status).name}")
    if memory > BYTES:
        raise Fault(f"takes {memory >> 20} MB of memory")
    if status == REFUSED:
        if not any(name in said for name in names):
            raise Fault(f"exit 3 without the name of the file ({' or '.join(names)})")
    elif status not in allowed:
        raise Fault(f"exit {status}")


def try_mutant(kind, files, folder, seed, number):
    """Makes one mutant below the folder and runs the tool on it; returns its exit status."""
    draw = random.Random(f"{seed}/{kind.name}/{number}")
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(files, folder)
    target = draw.choice(kind.files(folder))
    target.write_bytes(kind.mutate(target.read_bytes(), draw))
    command = [word.format(target=target, folder=folder) for word in draw.choice(kind.commands)]
    (folder / "command").write_text(" ".join(command) + "\n")
    status, said, memory = _limited([os.environ["LOCKBOX_TOOL"], *command],
                                    {"XDG_CACHE_HOME": str(folder / kind.cache)})
    (folder / "said").write_text(said)
    check(status, said, memory, kind.allowed, [target.name])
    return status


def run_kind(kind, files, count, seed, keep=None):
    """Tries so many mutants; returns how often each exit status came, and what was wrong."""
    statuses, faults = collections.Counter(), []
    with tempfile.TemporaryDirectory(prefix="lockbox-damage-") as place:
        folder = pathlib.Path(place) / "mutant"
        for number in range(count):
            try:
                statuses[try_mutant(kind, files, folder, seed, number)] += 1
            except Fault as fault:
                faults.append(f"{kind.name} {number} of seed {seed}: {fault}\n" +
                              ((folder / "said").read_text() if (folder / "said").exists() else ""))
                if keep:
                    shutil.copytree(folder, keep / f"{kind.name}-{seed}-{number}",
                                    dirs_exist_ok=True)
    return statuses, faults


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=500, help="mutants of each kind (500)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--kinds", nargs="+", choices=[kind.name for kind in kinds.KINDS],
                        help="only these")
    parser.add_argument("--keep", type=pathlib.Path, default=pathlib.Path("out/damage"),
                        help="folder for mutants that are faults (out/damage)")
    options = parser.parse_args()
    all_faults = []
    with tempfile.TemporaryDirectory(prefix="lockbox-sound-") as place:
        files = pathlib.Path(place)
        kinds.write_sound_files(files)
        for kind in kinds.KINDS:
            if options.kinds and kind.name not in options.kinds:
                continue
            statuses, faults = run_kind(kind, files, options.count, options.seed, options.keep)
            ends = ", ".join(f"{n} exit {status}" for status, n in sorted(statuses.items()))
            print(f"{kind.name:9} {options.count} mutants: {ends}, {len(faults)} faults",
                  flush=True)
            print("".join(f"  {fault.strip()}\n" for fault in faults), end="", flush=True)
            all_faults += faults
    return 1 if all_faults else 0


if __name__ == "__main__":
    sys.exit(main())
