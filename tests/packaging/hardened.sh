#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# hardened.sh FOLDER... fails if a program or library below the folders lacks what LOCKBOX_HARDEN
# promises, or would look for libraries in the working directory.
set -euo pipefail

failed=0
problem() {
  echo "$1: $2"
  failed=1
}

has_symbol() { grep --quiet "UND $2" <<<"$(readelf --dyn-syms --wide "$1")"; }

check() {
  local file=$1 dynamic headers path element
  dynamic=$(readelf --dynamic --wide "$file")
  headers=$(readelf --file-header --program-headers --wide "$file")
  grep --quiet "Type: *DYN" <<<"$headers" ||
    problem "$file" "is loaded at a fixed address (no PIE)"
  grep --quiet --extended-regexp 'BIND_NOW|Flags:.* NOW' <<<"$dynamic" ||
    problem "$file" "binds functions late (no -z now)"
  grep --quiet GNU_RELRO <<<"$headers" ||
    problem "$file" "its tables stay writable (no -z relro)"
  has_symbol "$file" __stack_chk_fail || problem "$file" "has no stack protector"
  # One that is empty stands for the working directory, and so may one that is relative.
  path=$(sed -n 's/.*(R\(UN\)\?PATH).*\[\(.*\)\]/\2:/p' <<<"$dynamic")
  while [[ -n $path ]]; do
    element=${path%%:*}
    path=${path#*:}
    [[ $element == '$ORIGIN'* || $element == /* ]] ||
      problem "$file" "'$element' in its library path"
  done
}

checked=0
fortified=0
while IFS= read -r -d '' file; do
  [[ $(head --bytes=4 "$file" | tr -d '\0') == $'\177ELF' ]] || continue
  check "$file"
  checked=$((checked + 1))
  # Only what calls a function that has a checked form shows it.
  if has_symbol "$file" '__[a-z]*_chk@'; then fortified=$((fortified + 1)); fi
done < <(find "$@" -type f \( -name '*.so*' -o -perm -u=x \) -print0)

((checked > 0)) || problem "$*" "holds no programs and libraries"
((fortified > 0)) || problem "$*" "nothing was built with _FORTIFY_SOURCE"
((failed == 0)) && echo "$checked programs and libraries, all hardened, $fortified with _FORTIFY_SOURCE"
exit "$failed"
