#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# What a new user does first with the installed packages: the tutorial, without camera and display.
set -euo pipefail
cd "$(mktemp -d)"

lockbox --version
status=0
lockbox devices 2>message || status=$?
((status == 4)) && grep --quiet 'no depth camera that OpenNI2 knows' message
lockbox inspect --model cabinet --picture cabinet.png
lockbox simulate --model cabinet --trajectory auto --scene room --frames 20 --output out/cabinet.oni
lockbox track --model cabinet --source out/cabinet.oni --output out/run --snapshots out/snapshots
lockbox evaluate --estimate out/run/states.csv --reference out/groundtruth.csv --output out/errors
[[ $(wc --lines <out/run/states.csv) == 21 && -s out/errors/summary.json ]]
lockbox experiment --help >/dev/null
pkg-config --exists lockbox
python3 -c 'import lockbox; print(lockbox.load_model("cabinet"), lockbox.__file__)'
