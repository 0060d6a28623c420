#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Plots a run of `lockbox track`: the base and the joints over time, with three standard deviations.

    plot_run.py out/run [--output run.png]
"""

import argparse
import csv
import pathlib
import sys

import matplotlib.pyplot as plt
import numpy as np


def read_states(file):
    """The columns of a states file by name: arrays of floats, but words for `status`."""
    with open(file, newline="") as stream:
        rows = list(csv.DictReader(stream))
    if not rows:
        raise ValueError(f"{file}: holds no rows")
    return {name: [row[name] for row in rows] if name == "status"
            else np.array([float(row[name]) for row in rows]) for name in rows[0]}


def plot_base(axes, states):
    """The base's position from where it was first known, millimetres."""
    time = states["timestamp"]
    for name in ("tx", "ty", "tz"):
        known = states[name][np.isfinite(states[name])]
        start = known[0] if known.size else 0.0
        axes.plot(time, 1000 * (states[name] - start), label=name)
    axes.set_ylabel("base, mm from its start")
    axes.legend()


def plot_joint(axes, states, name):
    """A joint's position; shaded where the frame determines it: three standard deviations."""
    time, position = states["timestamp"], states[name]
    sigma = np.where(np.isfinite(states[name + ".sigma"]), states[name + ".sigma"], np.nan)
    axes.plot(time, position)
    axes.fill_between(time, position - 3 * sigma, position + 3 * sigma, alpha=0.3)
    axes.set_ylabel(name)


def plot(states, title):
    """The figure of a run."""
    joints = [name[:-len(".sigma")] for name in states if name.endswith(".sigma")]
    figure, axes = plt.subplots(1 + len(joints), sharex=True, squeeze=False,
                                figsize=(8, 2.5 + 1.5 * len(joints)), layout="constrained")
    plot_base(axes[0, 0], states)
    for row, name in enumerate(joints, start=1):
        plot_joint(axes[row, 0], states, name)
    axes[-1, 0].set_xlabel("time, s")
    tracked = sum(status == "tracking" for status in states["status"])
    figure.suptitle(f"{title}: {tracked} of {len(states['status'])} frames tracked")
    return figure


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("run", type=pathlib.Path, help="folder of the run, or its states.csv")
    parser.add_argument("--output", type=pathlib.Path, help="picture (.png, .svg, .pdf); else a window")
    arguments = parser.parse_args()
    file = arguments.run / "states.csv" if arguments.run.is_dir() else arguments.run
    try:
        figure = plot(read_states(file), file.parent.name)
        if arguments.output:
            figure.savefig(arguments.output)
        else:
            plt.show()
    except (OSError, ValueError, KeyError) as error:
        print(f"plot_run.py: {error}", file=sys.stderr)
        return 3
    return 0


if __name__ == "__main__":
    sys.exit(main())
