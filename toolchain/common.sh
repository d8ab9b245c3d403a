# SPDX-License-Identifier: Apache-2.0
# What the scripts here share: messages to the user, building, testing. Sourced, not run.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# Paths relative to this folder let ccache use objects of another checkout.
export CCACHE_BASEDIR=$root

# use_preset NAME: selects what the functions below configure, build and test.
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

# One job per processor, but at most one per 2 GiB of free memory: compiling CGAL needs much.
job_count() {
  local by_memory
  by_memory=$(awk '/^MemAvailable/ {print int($2 / 2097152)}' /proc/meminfo)
  local by_cpu
  by_cpu=$(nproc)
  local jobs=$((by_memory < by_cpu ? by_memory : by_cpu))
  echo $((jobs > 0 ? jobs : 1))
}

# Whether the preset's build folder was configured by this checkout at its present place.
is_configured() {
  grep -qsxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$build/CMakeCache.txt"
}

# configure [CMAKE_ARGUMENT...]: configures the preset's build folder. Deletes a cache made by a
# checkout that has since moved, because CMake would only refuse it.
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

# compile [TARGET...]: builds the targets, or everything if none is named.
compile() {
  local jobs
  jobs=$(job_count)
  say "Building ${*:-everything} ($jobs at a time)"
  local targets=()
  [ $# -eq 0 ] || targets=(--target "$@")
  cmake --build "$build" -j "$jobs" "${targets[@]}" ||
    die "the build failed" "The first message above that says 'error' or 'FAILED' is the cause."
}

# Reports of the sanitizers on any process of the tests, also on helper processes whose failure a
# test tolerates. Without reports of exhausted memory, which some tests cause on purpose.
sanitizer_reports() {
  grep -lsE 'ERROR: AddressSanitizer: |runtime error: |ERROR: LeakSanitizer: detected' \
    "$build"/Testing/sanitizer.* |
    xargs -r grep -LE 'AddressSanitizer: (out-of-memory|allocator is out of memory)' || true
}

# run_tests [CTEST_ARGUMENT...]: keeps the results for promises.py until the same tests run again.
run_tests() {
  say "Testing ($preset)"
  local results=$build/Testing/results status=0 found watch=()
  results+=/$(cksum <<<"$*" | cut -d' ' -f1).xml
  if [ "$preset" = sanitize ]; then
    rm -f "$build"/Testing/sanitizer.*
    watch=({ASAN,UBSAN}_OPTIONS="log_path=$build/Testing/sanitizer")
  fi
  # Suppresses leaks of libraries; only the address sanitizer reads this variable.
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
