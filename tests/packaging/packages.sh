#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# packages.sh BUILD_FOLDER PYTHON builds the Debian packages of a build folder, unpacks them below a
# root of their own, and uses what is there.
set -euo pipefail
build=$1 python=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
root=$folder/root

fail() {
  echo "packages: $*" >&2
  exit 1
}

field() { dpkg-deb --field "$folder/$1"_*.deb "$2"; }

cpack --config "$build/CPackConfig.cmake" -B "$folder" >"$folder/log" 2>&1 || fail "$(cat "$folder/log")"
rm -rf "$folder/_CPack_Packages"
packages=("$folder"/*.deb)
mkdir "$root"
for package in "${packages[@]}"; do
  dpkg-deb --extract "$package" "$root"
  dpkg-deb --fsys-tarfile "$package" | tar --list | grep --invert-match '/$'
done | sort | uniq --repeated >"$folder/twice"
[[ ! -s $folder/twice ]] || fail "in two packages: $(cat "$folder/twice")"

# What each needs, as far as it can be said without asking what it was built with.
libraries=$(basename "$folder"/liblockbox*.deb | cut --delimiter=_ --fields=1)
version=$(field lockbox Version)
[[ $(field "$libraries" Depends) == *libopenni2-0*libpcl-common* ]] || fail "OpenNI2 or PCL is missing"
[[ $(field lockbox Depends) == *"$libraries (= $version)"*"lockbox-data (= $version)"* ]] ||
  fail "lockbox depends on $(field lockbox Depends)"
[[ $(field lockbox-data Architecture) == all ]] || fail "the models are for one architecture"

export XDG_CACHE_HOME=$build/cache HOME=$folder
lockbox=$root/usr/bin/lockbox
"$lockbox" --version
"$lockbox" simulate --model rigid_block --trajectory auto --frames 3 --scene room --quiet \
  --output "$folder/block.oni"
"$lockbox" track --model rigid_block --source "$folder/block.oni" --quiet \
  --initial-state "$folder/groundtruth.csv" --output "$folder/run"
[[ $(wc --lines <"$folder/run/states.csv") == 4 ]] || fail "not a row for each frame"
[[ $("$lockbox" experiment --help) == *convergence* ]] || fail "there are no experiments"
gzip --test "$root"/usr/share/man/man1/lockbox{,-track}.1.gz
[[ -s $root/usr/share/doc/lockbox/docs/how-to/live.md ]] || fail "there are no documents"
# What two versions could not share.
[[ -d $root/usr/lib/lockbox/${libraries#liblockbox} ]] || fail "components without a version"
[[ $(ls "$root/usr/lib/lockbox") == "${libraries#liblockbox}" ]] || fail "components beside their folder"
[[ -s $root/usr/share/bash-completion/completions/lockbox ]] || fail "there is no completion"
if [[ -d $root/usr/lib/python3 ]]; then
  PYTHONPATH=$root/usr/lib/python3/dist-packages "$python" -B -c \
    'import lockbox; print(lockbox.load_model("rigid_block"))'
fi

# Debian's own checks.
command -v lintian >/dev/null || fail "there is no lintian; scripts/setup installs it"
lintian --allow-root --fail-on error,warning "${packages[@]}" || fail "lintian complains"
printf '%s\n' "${packages[@]##*/}"
