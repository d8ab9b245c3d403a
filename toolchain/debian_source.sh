#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Fetches and unpacks the source of one of Debian's packages, of the version that this Debian has,
# with apt-get's own check of signatures. Needs no rights, and leaves the system's lists alone.
#
#   debian_source.sh PACKAGE FOLDER     FOLDER is made, and holds the source afterwards
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
mkdir -p "$work/lists/partial" "$work/cache"

# The places of this system's packages, which hold the sources, too.
apt-get indextargets --format 'deb-src $(REPO_URI) $(RELEASE) $(COMPONENT)' \
  'Created-By: Packages' 'Origin: Debian' | sort -u >"$work/sources.list"
[ -s "$work/sources.list" ] || die "apt-get knows no package source of Debian: run apt-get update"
options=(-q -o Dir::Etc::SourceList="$work/sources.list" -o Dir::Etc::SourceParts=/dev/null
  -o Dir::State::Lists="$work/lists" -o Dir::Cache="$work/cache" -o APT::Sandbox::User="$(id -un)")
version=$(dpkg-query -W -f='${source:Version}\n' "$package[0-9]*" "$package" 2>/dev/null |
  grep -m 1 . || true)
log=$work/log
apt-get "${options[@]}" update >"$log" 2>&1 &&
  (cd "$work" && apt-get "${options[@]}" source --download-only "$package${version:+=$version}") \
    >>"$log" 2>&1 || {
  grep -E '^(E|W|Err):' "$log" | tail -n 5 >&2
  die "the source of $package could not be fetched"
}
mkdir -p "$(dirname "$folder")"
dpkg-source -q --no-check -x "$work"/*.dsc "$folder"  # apt-get has checked it
