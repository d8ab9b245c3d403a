#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Fetches and unpacks the source of one of Debian's packages, of the version that this Debian has,
# with apt-get's own check of signatures. Needs no rights, and leaves the system's lists alone.
# What was fetched is kept, and fetched once.
#
#   debian_source.sh PACKAGE FOLDER     FOLDER is made, and holds the source afterwards
#
# STYLET_DEBIAN_SOURCES names the folder where it is kept: for a machine without a network one that
# holds what `apt-get source --download-only PACKAGE` fetched elsewhere. Else it is
# ~/.cache/stylet/sources.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

[ $# -eq 2 ] ||
  die "expected PACKAGE FOLDER" "For example: toolchain/debian_source.sh libccd /tmp/libccd"
package=$1 folder=$2
[ ! -e "$folder" ] || die "$folder is there already"
for program in apt-get dpkg-source; do
  command -v "$program" >/dev/null || die "no $program here: expected a Debian system with dpkg-dev"
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
log=$work/log
version=$(dpkg-query -W -f='${source:Version}\n' "${package}[0-9]*" "$package" 2>/dev/null |
  grep -m 1 . || true)
kept=${STYLET_DEBIAN_SOURCES:-${XDG_CACHE_HOME:-${HOME:-/nonexistent}/.cache}/stylet/sources}

# Into the folder, at once: another may be at the same.
unpack() {
  # apt-get has checked the signature; the sums of the archives are checked here.
  rm -rf "$work/source"
  dpkg-source -q --no-check -x "$1" "$work/source" >>"$log" 2>&1 || return
  mkdir -p "$(dirname "$folder")"
  cp -r "$work/source" "$folder.$$"
  mv -T "$folder.$$" "$folder" 2>/dev/null || { rm -rf "$folder.$$" && [ -d "$folder" ]; }
}

fetch() {
  mkdir -p "$work/lists/partial" "$work/cache" "$work/fetched"
  # The places of this system's packages, which hold the sources, too.
  apt-get indextargets --format 'deb-src $(REPO_URI) $(RELEASE) $(COMPONENT)' \
    'Created-By: Packages' 'Origin: Debian' | sort -u >"$work/sources.list"
  if [ ! -s "$work/sources.list" ]; then
    echo "E: apt-get knows no package source of Debian: run apt-get update" >>"$log"
    return 1
  fi
  local options=(-q -o Dir::Etc::SourceList="$work/sources.list" -o Dir::Etc::SourceParts=/dev/null
    -o Dir::State::Lists="$work/lists" -o Dir::Cache="$work/cache"
    -o APT::Sandbox::User="$(id -un)")
  apt-get "${options[@]}" update >>"$log" 2>&1 &&
    (cd "$work/fetched" &&
      apt-get "${options[@]}" source --download-only "$package${version:+=$version}") \
      >>"$log" 2>&1
}

# The archives first: where the .dsc is, all of it is.
keep() {
  mkdir -p "$kept" && find "$work/fetched" -type f ! -name '*.dsc' -exec cp -t "$kept" {} + &&
    cp "$work"/fetched/*.dsc "$kept/.new.$$" &&
    mv "$kept/.new.$$" "$kept/$(basename "$work"/fetched/*.dsc)"
}

# Without an epoch, as in names of files.
dsc=$(find "$kept" -name "${package}_${version:+${version#*:}.dsc}*" -name '*.dsc' 2>/dev/null |
  sort -V | tail -n 1 || true)
if [ -n "$dsc" ] && unpack "$dsc"; then exit 0; fi
if ! fetch; then
  grep -E '^(E|W|Err):' "$log" | tail -n 5 >&2
  die "the source of $package could not be fetched" \
    "Without a network STYLET_DEBIAN_SOURCES can name a folder with it, made where one is by" \
    "  apt-get source --download-only $package${version:+=$version}"
fi
unpack "$work"/fetched/*.dsc || die "the source of $package could not be unpacked" "$(tail "$log")"
keep 2>/dev/null || true  # a home that cannot be written to
