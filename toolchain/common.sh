# SPDX-License-Identifier: Apache-2.0
# What setup.sh, demo.sh and test.sh share: speaking to the user, and building. Sourced, not run.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build/release

say() { printf '\n==> %s\n' "$*"; }
note() { printf '    %s\n' "$*"; }
die() {
  printf '\nerror: %s\n' "$1" >&2
  shift
  for line in "$@"; do printf '       %s\n' "$line" >&2; done
  exit 1
}

# A job for each processor, but no more than one for each 2 GiB of free memory: CGAL is large.
job_count() {
  local by_memory
  by_memory=$(awk '/^MemAvailable/ {print int($2 / 2097152)}' /proc/meminfo)
  local by_cpu
  by_cpu=$(nproc)
  local jobs=$((by_memory < by_cpu ? by_memory : by_cpu))
  echo $((jobs > 0 ? jobs : 1))
}

# configure: a release build in build/release. A cache made by a checkout that has since moved is
# thrown away, as CMake would only refuse it.
configure() {
  mkdir -p "$build" 2>/dev/null && [ -w "$build" ] ||
    die "cannot write to $build" "Give this user the right to write there, or run as its owner."
  local cache=$build/CMakeCache.txt
  if [ -f "$cache" ] && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$cache"; then
    note "build folder belongs to another place, starting it afresh"
    rm -rf "$build"
    mkdir -p "$build"
  fi
  say "Configuring (release) in ${build#"$root"/}"
  local log=$build/configure.log
  (cd "$root" && cmake --preset release >"$log" 2>&1) || {
    tail -n 25 "$log" >&2
    die "configuring failed" "The whole output is in $log"
  }
}

# compile [TARGET...]: everything when no target is named.
compile() {
  local jobs
  jobs=$(job_count)
  say "Building ${*:-everything} ($jobs at a time)"
  local targets=()
  [ $# -eq 0 ] || targets=(--target "$@")
  cmake --build "$build" -j "$jobs" "${targets[@]}" ||
    die "the build failed" "The first message above that says 'error' or 'FAILED' is the cause."
}
