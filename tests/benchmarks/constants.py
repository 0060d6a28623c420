#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What each quantity of the evidence does when it is halved or doubled: a few kinds of `lockbox experiment mismatch`,
of four models, again with each. The table tells how many frames are right, how many are called `tracking`, and how many of
these are wrong. It goes on where it was stopped.

  tests/benchmarks/constants.py TOOL OUTPUT [--only NAME]... [--seed N] [--frames N]
"""

import argparse
import csv
import pathlib
import re
import subprocess

OPTIONS = pathlib.Path(__file__).parents[2] / "modules/verification/include/lockbox/verification/evidence_options.hpp"
KINDS = ("none", "scale", "missing", "depth-bend", "all")
MODELS = ("lockbox", "cabinet", "rigid_block", "board_door_block")


def quantities():
    """Their names and usual values."""
    return {name: float(value) for name, value in re.findall(r"^  double (\w+) = ([\d.e-]+);", OPTIONS.read_text(), re.M)}


def run(arguments, setting):
    """The rows of all kinds and models, with that setting."""
    command = [arguments.tool, "experiment", "mismatch", "--quiet", "--output", arguments.output, "--seeds", "1",
               "--seed", str(arguments.seed), "--frames", str(arguments.frames)]
    for kind in KINDS:
        command += ["--kind", kind]
    for model in MODELS:
        command += ["--model", model]
    subprocess.run(command + (["--set", setting] if setting else []), check=True, stdout=subprocess.DEVNULL)
    rows = []
    for model in MODELS:
        name = f"mismatch_{model}_moderate_primesense_{arguments.frames}frames" + (f"_{setting}" if setting else "")
        with open(pathlib.Path(arguments.output) / f"{name}.csv", newline="") as file:
            rows += list(csv.DictReader(file))
    return rows


def table_row(what, rows):
    trusted = [row for row in rows if row["status"] == "tracking"]
    right = sum(row["right"] == "1" for row in rows)
    wrong = sum(row["right"] != "1" for row in trusted)
    print(f"| {what} | {right} of {len(rows)} | {len(trusted)} | {wrong} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("tool")
    parser.add_argument("output")
    parser.add_argument("--only", action="append", help="quantity (repeatable; all, if none is given)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--frames", type=int, default=3)
    arguments = parser.parse_args()
    print("| | right | `tracking` | of these wrong |\n|---|---|---|---|")
    table_row("as they are", run(arguments, ""))
    for name, value in quantities().items():
        if arguments.only and name not in arguments.only:
            continue
        for factor in (0.5, 2.0):
            setting = f"evidence_{name}={factor * value:g}"
            table_row(f"`{setting}`", run(arguments, setting))


if __name__ == "__main__":
    main()
