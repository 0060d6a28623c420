#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# fresh_root.sh PACKAGE.deb... installs the packages into a fresh Debian 12, and uses them there as a new
# user does: first alone, then through every tutorial, with what these need beside lockbox (a compiler, a
# virtual display, ROS; the camera is the virtual one). Needs root, mmdebstrap, and Debian's servers.
set -euo pipefail
here=$(dirname "${BASH_SOURCE[0]}")
beside=(cmake g++ pkg-config python3-pytest python3-matplotlib xvfb xauth libgl1-mesa-dri ffmpeg gnuplot-nox
  python3-rospy python3-rosmaster python3-sensor-msgs python3-geometry-msgs)

documents=$(mktemp --suffix .tar)
trap 'rm -f "$documents"' EXIT
tar --create --file "$documents" --directory "$here/../.." README.md docs scripts share tests/python

hooks=(--customize-hook='mkdir "$1/debs"')
for package in "$@"; do hooks+=(--customize-hook="copy-in $package /debs"); done
mmdebstrap --variant=minbase --include=ca-certificates "${hooks[@]}" \
  --customize-hook='chroot "$1" sh -c "apt-get install --yes --no-install-recommends /debs/*.deb"' \
  --customize-hook='chroot "$1" useradd --create-home --shell /bin/bash user' \
  --customize-hook="copy-in $here/first_use.sh $here/tutorials.sh /home/user" \
  --customize-hook='chroot "$1" su --login user --command "bash first_use.sh"' \
  --customize-hook="chroot \"\$1\" apt-get install --yes --no-install-recommends ${beside[*]}" \
  --customize-hook="tar-in $documents /home/user" \
  --customize-hook='chroot "$1" su --login user --command "bash tutorials.sh"' \
  bookworm /dev/null
echo "fresh root: all works"
