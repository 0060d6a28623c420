#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Every tutorial with the installed packages: the commands and programs of the documents as they stand
# there, by the tests that a build runs with its own.
set -euo pipefail
export LOCKBOX_TOOL=/usr/bin/lockbox LOCKBOX_PACKAGE=/usr/lib/python3/dist-packages MPLBACKEND=Agg
cd "$(dirname "${BASH_SOURCE[0]}")/tests/python"
# What compares a document with the sources is left out: there are none here.
for name in readme tutorial own_object own_sensor live_how_to publish_how_to python_doc plot_run embed \
  pcl_registration; do
  /usr/bin/python3 -B -m pytest -q -p no:cacheprovider -k "not messages_of_the_table" "test_$name.py"
done
