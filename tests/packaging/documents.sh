#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# documents.sh PREFIX LIBRARIES: whether each docs/*.md that a program, a library, a manual page or an
# installed document names is in the installation.
set -euo pipefail
prefix=$1 libraries=$2
folder=$prefix/share/doc/lockbox

named() {
  grep --recursive --text --only-matching --no-filename --extended-regexp '\bdocs/[a-z/-]+\.md' \
    "$prefix/bin" "$libraries"/liblockbox_* "$libraries"/lockbox
  find "$prefix/share/man" -name 'lockbox*' -exec zcat --force {} + |
    sed 's/\\\\-/-/g' | grep --only-matching --extended-regexp '\bdocs/[a-z/-]+\.md'
  grep --only-matching --extended-regexp '\bdocs/[a-z/-]+\.(md|png)' "$folder/README.md"
}

names=$(named | sort --unique)
(($(wc --words <<<"$names") > 5)) || { echo "documents: hardly any is named: $names" >&2; exit 1; }
for name in $names; do
  [[ -s $folder/$name ]] || { echo "documents: $name is not installed in $folder" >&2; exit 1; }
done
told=$("$prefix/bin/lockbox" track --model cabinet --source "$folder/docs/images" --sensor none 2>&1 || true)
[[ $told == *"$folder/docs/sensors.md"* ]] || { echo "documents: not where it is: $told" >&2; exit 1; }
printf '%s\n' "$names"
