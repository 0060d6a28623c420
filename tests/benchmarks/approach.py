#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Whether `--sensor auto` follows the noise: a camera goes away from an object, or comes near to it, and the
table tells residual_rms (median) in the first and in the last third of the way.

  tests/benchmarks/approach.py TOOL OUTPUT [SENSOR]... [--frames N]
"""

import argparse
import csv
import math
import pathlib
import statistics
import subprocess

SENSORS = ("primesense", "primesense-quiet", "structured-light", "white", "time-of-flight", "kinect-v2", "stereo",
           "d4xx", "sr300", "ideal")
# Model, nearest and farthest distance (metres) of what reaches less far than the others.
NEAR_SENSORS = {"sr300": ("rigid_block", 0.5, 1.3)}
OTHERS = ("cabinet", 0.9, 2.7)


def read(file):
    with open(file, newline="") as stream:
        return list(csv.DictReader(stream))


def run(*command):
    subprocess.run([str(word) for word in command], check=True)


def write_way(states, near, far, file):
    """The states at distances that grow (shrink, where near is the farther one) smoothly, in the same direction."""
    for i, state in enumerate(states):
        share = 0.5 - 0.5 * math.cos(math.pi * i / (len(states) - 1))
        factor = near * (far / near) ** share / float(state["tz"])
        for name in ("tx", "ty", "tz"):
            state[name] = repr(factor * float(state[name]))
    with open(file, "w", newline="") as stream:
        writer = csv.DictWriter(stream, states[0].keys())
        writer.writeheader()
        writer.writerows(states)


def residuals(tool, sensor, folder, frames, is_away):
    """Medians of the first and of the last third, and the share of frames that are `tracking`."""
    model, near, far = NEAR_SENSORS.get(sensor, OTHERS)
    folder.mkdir(parents=True, exist_ok=True)
    run(tool, "simulate", "-m", model, "-t", "auto", "--frames", frames, "-q", "-o", folder / "still",
        "--sensor", "ideal", "--overwrite")
    write_way(read(folder / "still" / "groundtruth.csv"), *((near, far) if is_away else (far, near)),
              folder / "way.csv")
    run(tool, "simulate", "-m", model, "-t", folder / "way.csv", "--scene", "room", "-q", "--overwrite",
        "--sensor", sensor, "-o", folder / "way.oni")
    subprocess.run([tool, "track", "-m", model, "-s", folder / "way.oni", "-q", "--overwrite", "-o", folder / "run",
                    "--sensor", "auto", "--initial-state", folder / "way.csv"], check=False)
    rows = read(folder / "run" / "states.csv")
    third = len(rows) // 3
    medians = [statistics.median(float(row["residual_rms"]) for row in part) for part in (rows[:third], rows[-third:])]
    return *medians, sum(row["status"] == "tracking" for row in rows) / len(rows)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("tool")
    parser.add_argument("output", type=pathlib.Path)
    parser.add_argument("sensors", nargs="*", default=SENSORS)
    parser.add_argument("--frames", type=int, default=90)
    arguments = parser.parse_args()
    for sensor in arguments.sensors:
        cells = [f"`{sensor}`"]
        for is_away in (True, False):
            folder = arguments.output / sensor / ("away" if is_away else "near")
            first, last, share = residuals(arguments.tool, sensor, folder, arguments.frames, is_away)
            cells.append(f"{first:.2f}; {last:.2f}; {100 * share:.0f} %")
        print("| " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
