#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# fresh_root.sh PACKAGE.deb... installs the packages into a fresh Debian 12, and uses them there as a new
# user does. Needs root, mmdebstrap, and Debian's servers.
set -euo pipefail
here=$(dirname "${BASH_SOURCE[0]}")

hooks=(--customize-hook='mkdir "$1/debs"')
for package in "$@"; do hooks+=(--customize-hook="copy-in $package /debs"); done
mmdebstrap --variant=minbase --include=ca-certificates "${hooks[@]}" \
  --customize-hook='chroot "$1" sh -c "apt-get install --yes --no-install-recommends /debs/*.deb"' \
  --customize-hook='chroot "$1" useradd --create-home --shell /bin/bash user' \
  --customize-hook="copy-in $here/first_use.sh /home/user" \
  --customize-hook='chroot "$1" su --login user --command "bash first_use.sh"' \
  bookworm /dev/null
echo "fresh root: all works"
