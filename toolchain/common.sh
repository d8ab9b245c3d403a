# SPDX-License-Identifier: Apache-2.0
# What the scripts here share: speaking to the user, building, testing. Sourced, not run.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# Objects of another checkout serve this one: for ccache, paths count from here.
export CCACHE_BASEDIR=$root

# use_preset NAME: what the functions below configure, build and test, from here on.
use_preset() {
  preset=$1
  build=$root/build/$preset
}
use_preset release

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

# Whether the preset's build folder was configured, and by this checkout where it is now.
is_configured() {
  grep -qsxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$build/CMakeCache.txt"
}

# configure [CMAKE_ARGUMENT...]: the preset's build folder. A cache made by a checkout that has
# since moved is thrown away, as CMake would only refuse it.
configure() {
  mkdir -p "$build" 2>/dev/null && [ -w "$build" ] ||
    die "cannot write to $build" "Give this user the right to write there, or run as its owner."
  if [ -f "$build/CMakeCache.txt" ] && ! is_configured; then
    note "build folder belongs to another place, starting it afresh"
    rm -rf "$build"
    mkdir -p "$build"
  fi
  say "Configuring ($preset) in ${build#"$root"/}"
  local log=$build/configure.log
  (cd "$root" && cmake --preset "$preset" "$@" >"$log" 2>&1) || {
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

# What the address sanitizer said of any process of the tests, also of one beside a run whose end
# a test forgives. Out of memory are those that a test starves.
sanitizer_reports() {
  grep -lsE 'ERROR: AddressSanitizer: |runtime error: |ERROR: LeakSanitizer: detected' \
    "$build"/Testing/sanitizer.* |
    xargs -r grep -LE 'AddressSanitizer: (out-of-memory|allocator is out of memory)' || true
}

# run_tests [CTEST_ARGUMENT...]: the results stay for promises.py until the same are run again.
run_tests() {
  say "Testing ($preset)"
  local results=$build/Testing/results status=0 found watch=()
  results+=/$(cksum <<<"$*" | cut -d' ' -f1).xml
  if [ "$preset" = sanitize ]; then
    rm -f "$build"/Testing/sanitizer.*
    watch=({ASAN,UBSAN}_OPTIONS="log_path=$build/Testing/sanitizer")
  fi
  # Libraries leak too; only the address sanitizer asks.
  env LSAN_OPTIONS="suppressions=$root/toolchain/leaks.txt:print_suppressions=0" "${watch[@]}" \
    ctest --test-dir "$build" --output-on-failure -j 2 --output-junit "$results" \
      --test-output-size-passed 100000 "$@" || status=$?
  found=$(sanitizer_reports)
  [ -z "$found" ] || xargs head -n 60 <<<"$found" >&2
  [ $status -eq 0 ] ||
    die "some tests failed; they are listed above" \
      "One of them again, with its output:  ctest --test-dir ${build#"$root"/} -V -R NAME" \
      "The whole log: $build/Testing/Temporary/LastTest.log (ctest exit code $status)"
  [ -z "$found" ] ||
    die "every test passed, but a sanitizer found something in a process of theirs; it is above" \
      "$found"
}
