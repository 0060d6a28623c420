#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What a sensor's profile costs and gains: thirty frames of a model by each simulated sensor, tracked as if by a
PrimeSense, with the sensor's profile, and with `--sensor auto`. For each the table tells how many frames are called
`tracking`, and the medians of residual_rms, of the base's error (mm), and of the joints' error / sigma (root mean square).

  tests/benchmarks/profiles.py TOOL OUTPUT [SENSOR]... [--model NAME]... [--frames N]
"""

import argparse
import csv
import math
import pathlib
import statistics
import subprocess

SENSORS = ("primesense", "primesense-quiet", "structured-light", "white", "time-of-flight", "kinect-v2", "stereo",
           "d4xx", "ideal")


def read(file):
    with open(file, newline="") as stream:
        return list(csv.DictReader(stream))


def base_error(row, truth):
    return 1000 * math.dist(*([float(state[name]) for name in ("tx", "ty", "tz")] for state in (row, truth)))


def joint_ratios(row, truth):
    """Errors of known joints, in sigmas. Those that turn on may be off by whole turns."""
    for name in (key.removesuffix(".sigma") for key in row if key.endswith(".sigma")):
        sigma = float(row[name + ".sigma"])
        if math.isfinite(sigma) and sigma > 0:
            error = float(row[name]) - float(truth[name])
            yield min(abs(error), abs(math.remainder(error, 2 * math.pi))) / sigma


def cell(tool, recording, model, told, folder):
    command = [tool, "track", "-m", model, "-s", recording / "run.oni", "-q", "--overwrite", "-o", folder,
               "--sensor", told, "--initial-state", recording / "groundtruth.csv"]
    subprocess.run([str(word) for word in command], check=False)
    truths = read(recording / "groundtruth.csv")
    rows = read(folder / "states.csv")
    known = [(row, truth) for row, truth in zip(rows, truths) if row["status"] == "tracking"]
    if not known:
        return "none"
    ratios = [ratio for pair in known for ratio in joint_ratios(*pair)]
    rms = math.sqrt(statistics.fmean(ratio * ratio for ratio in ratios)) if ratios else math.nan
    residual = statistics.median(float(row["residual_rms"]) for row, _ in known)
    error = statistics.median(base_error(*pair) for pair in known)
    return f"{len(known)}; {residual:.2f}; {error:.2f}; {rms:.1f}"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("tool")
    parser.add_argument("output", type=pathlib.Path)
    parser.add_argument("sensors", nargs="*", default=SENSORS)
    parser.add_argument("--model", action="append")
    parser.add_argument("--frames", type=int, default=30)
    arguments = parser.parse_args()
    for model in arguments.model or ["lockbox", "cabinet"]:
        for sensor in arguments.sensors:
            recording = arguments.output / model / sensor
            recording.mkdir(parents=True, exist_ok=True)
            subprocess.run([arguments.tool, "simulate", "-m", model, "-t", "auto", "--frames",
                            str(arguments.frames), "--scene", "room",
                            "--seed", "3", "--sensor", sensor, "-q", "--overwrite", "-o", recording / "run.oni"],
                           check=True)
            cells = [cell(arguments.tool, recording, model, told, recording / told)
                     for told in ("primesense", sensor, "auto")]
            print("| " + " | ".join([model, f"`{sensor}`", *cells]) + " |", flush=True)


if __name__ == "__main__":
    main()
