#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# unique_symbols.sh FOLDER fails if two of its lockbox libraries define the same function or constant: a program that links
# both would use one of them for both, silently.
set -euo pipefail

libraries=("$1"/liblockbox_*.so)
[[ -e ${libraries[0]} ]] || { echo "no libraries in $1"; exit 1; }
twice=$(for library in "${libraries[@]}"; do
  nm --dynamic --demangle --defined-only "$library" | sed -n 's/^[0-9a-f]* [TDBR] \(lockbox::.*\)/\1/p' |
    sort --unique
done | sort | uniq --repeated)
if [[ -n $twice ]]; then
  echo "defined by more than one library:"
  echo "$twice"
  exit 1
fi
echo "${#libraries[@]} libraries, no symbol defined twice"
