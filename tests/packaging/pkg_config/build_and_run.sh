#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# build_and_run.sh COMPILER LIBRARIES MODEL [FLAG]... builds the program beside it with what pkg-config
# says of the lockbox in the folder LIBRARIES, and runs it on the model.
set -euo pipefail
compiler=$1 libraries=$2 model=$3
shift 3
here=$(dirname "${BASH_SOURCE[0]}")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

export PKG_CONFIG_PATH=$libraries/pkgconfig
read -r -a flags < <(pkg-config --cflags --libs lockbox)
"$compiler" -std=c++20 "$@" "$here/main.cpp" -o "$folder/program" "${flags[@]}" \
  -Wl,-rpath,"$libraries"
"$folder/program" "$model"

# What it was linked with is asked for by the version that it was made for.
minor=$(pkg-config --modversion lockbox | cut --delimiter=. --fields=1,2)
readelf --dynamic --wide "$folder/program" | grep "NEEDED.*\[liblockbox_model.so.$minor\]"
