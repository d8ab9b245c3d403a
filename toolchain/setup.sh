#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs missing packages of Debian 12. This is the only list of packages; it has four parts.
#
#   setup.sh run        to run the programs and their scripts
#   setup.sh develop    the same, and to build
#   setup.sh test       the same, and for the tests of the tier `fast`; this is the default
#   setup.sh full       the same, and for those of the tiers `full` and `night`
#   setup.sh --list run|develop|test|full    only lists the packages
#
# Needs no rights if nothing is missing.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

to_run=(
  # figures; scripts beside scenes and in offline/analysis
  gnuplot-nox fonts-dejavu-core python3 python3-h5py python3-matplotlib python3-numpy
  # libraries for programs that were built elsewhere
  libbz2-1.0 libccd2 libdcmtk17 libexpat1 libfmt9 libgmp10 libhdf5-103-1 libinsighttoolkit5.2
  libmd0 libmpfr6 libopenigtlink1.11 libpng16-16 libssl3 libstdc++6 zlib1g
)
to_develop=(
  build-essential ccache cmake ninja-build pkg-config
  # kernel
  flatbuffers-compiler libccd-dev libflatbuffers-dev libmd-dev
  # hal
  libboost-dev libcli11-dev libfmt-dev libhdf5-dev libopenigtlink-dev libtomlplusplus-dev
  nlohmann-json3-dev pybind11-dev python3-dev python3-pip python3-setuptools python3-wheel
  # offline
  libbz2-dev libcgal-dev libdcmtk-dev libeigen3-dev libexpat1-dev libinsighttoolkit5-dev libpng-dev
  libssl-dev zlib1g-dev
)
to_test=(
  clang groff-base libbenchmark-dev libbullet-dev libclang-rt-14-dev libclang-rt-19-dev libgmock-dev
  libgtest-dev llvm python3-distributed python3-prometheus-client python3-pydicom python3-scipy
  snakemake valgrind
  # packages: judged, and installed in a Debian of their own
  debootstrap lintian
  # cohorts under Slurm; the test starts its own daemons
  munge slurm-client slurmctld slurmd
  # the interface in C from other languages
  mono-mcs mono-runtime mypy octave octave-dev
  # the console's page, which to build and run needs neither; the package for npm
  chromium emscripten nodejs
  # the book
  doxygen libjs-katex mkdocs-material
  # other processors
  g++-aarch64-linux-gnu g++-i686-linux-gnu gcc-arm-none-eabi libstdc++-arm-none-eabi-newlib
  qemu-system-arm qemu-system-x86 qemu-user
)
# 190 MB to be fetched, 1.2 GB on the disk; tests of the tier `full` are skipped without them.
to_test_fully=(
  # stylet.dll, and a Windows to run it in
  g++-mingw-w64-x86-64-posix wine wine64
  # an engine that loads the library for Godot
  godot3-server
)
# A nodejs that is not Debian's has its own npm and conflicts with Debian's npm.
command -v npm >/dev/null || to_test+=(npm)

list_only=
[ "${1:-}" != --list ] || { list_only=yes && shift; }
purpose=${1:-test}
[[ $# -le 1 && $purpose =~ ^(run|develop|test|full)$ ]] ||
  die "expected one of run, develop, test, full" "For example: toolchain/setup.sh develop"
packages=("${to_run[@]}")
[ "$purpose" = run ] || packages+=("${to_develop[@]}")
[[ ! $purpose =~ ^(test|full)$ ]] || packages+=("${to_test[@]}")
[ "$purpose" != full ] || packages+=("${to_test_fully[@]}")
[ -z "$list_only" ] || { printf '%s\n' "${packages[@]}" && exit; }

missing_packages() {
  local installed
  installed=$(dpkg-query -W -f='${Package} ${db:Status-Status}\n' "${packages[@]}" 2>/dev/null |
    awk '$2 == "installed" {print $1}') || true
  local package
  for package in "${packages[@]}"; do
    grep -qxF "$package" <<<"$installed" || echo "$package"
  done
}

check_debian() {
  command -v apt-get >/dev/null && command -v dpkg-query >/dev/null ||
    die "this script needs a Debian system (apt-get and dpkg-query were not found)" \
      "Elsewhere, install what these packages hold, then run cmake --preset release:" \
      "${packages[*]}"
}

as_root=()
become_root() {
  [ "$(id -u)" -ne 0 ] || return 0
  command -v sudo >/dev/null ||
    die "packages are missing, this user is not root, and there is no sudo" \
      "Run as root:  apt-get install ${missing[*]}"
  sudo -n true 2>/dev/null || [ -t 0 ] ||
    die "packages are missing, and sudo asks for a password where there is no terminal" \
      "Run once in a terminal:  sudo apt-get install ${missing[*]}"
  as_root=(sudo)
}

# Runs apt-get with its output in the log, and prints a line for every tenth of the progress. This
# has its own descriptor, opened after sudo: apt-get closes it for the packages' scripts, and if it
# were standard output, scripts that print would fail.
apt() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 \
    sh -c 'exec apt-get "$@" 3>&1' apt-get -y -o DPkg::Lock::Timeout=300 -o Dpkg::Use-Pty=0 \
    -o APT::Status-Fd=3 "$@" 2>&1 | tee -a "$log" | show_progress
}

show_progress() {
  local kind percent step shown=""
  while IFS=: read -r kind _ percent _; do
    case $kind in dlstatus) kind=downloaded ;; pmstatus) kind=installed ;; *) continue ;; esac
    [[ $percent =~ ^([0-9]*)[0-9](\.|$) ]] || continue
    step=${BASH_REMATCH[1]:-0}0
    [ "$step" -gt 0 ] && [ "$kind $step" != "$shown" ] || continue
    shown="$kind $step"
    note "$shown %"
  done
}

# Exits with the reason, taken from the log of apt-get.
explain_failure() {
  local offline='Temporary failure|Could not (resolve|connect)|Connection (failed|timed out)'
  if grep -qE "$offline" "$log"; then
    die "the packages could not be downloaded: no network, or the package source is down" \
      "$(grep -E "$offline" "$log" | grep -m 1 -oE 'https?://.*' || true)"
  fi
  grep -E '^(E:|Err:|dpkg: error)' -A 1 "$log" | grep -v '^--' | awk '!seen[$0]++' | tail -n 15 >&2
  die "installing the packages failed, for the reason above"
}

install_missing() {
  log=$(mktemp)
  trap 'rm -f "$log"' EXIT
  say "Installing ${#missing[@]} missing packages"
  note "${missing[*]}"
  # One unreachable source of several may not matter; the installation will tell.
  apt update >/dev/null || true
  apt install --no-install-recommends "${missing[@]}" || explain_failure
}

# Installs the npm packages for tests of the console's page, which are skipped without network. Not
# with `npm ci`: it refuses a lock file without the packages for other processors.
install_page_packages() {
  local page=$root/hal/console/page
  [ "$page/package-lock.json" -nt "$page/node_modules/.package-lock.json" ] || return 0
  say "Installing the npm packages of the console's page"
  local command=(npm install --no-save --ignore-scripts --no-audit --no-fund)
  (cd "$page" && timeout 300 "${command[@]}" >/dev/null 2>&1) ||
    note "npm could not install them: the tests of the page will be skipped"
}

check_debian
mapfile -t missing < <(missing_packages)
if [ ${#missing[@]} -gt 0 ]; then
  become_root
  install_missing
  mapfile -t missing < <(missing_packages)
  [ ${#missing[@]} -eq 0 ] || die "still missing after the installation: ${missing[*]}"
fi
[[ ! $purpose =~ ^(test|full)$ ]] || install_page_packages
say "All ${#packages[@]} packages are there"
