#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Makes a Debian 12 machine fit for Stylet's loop, and takes it back.
#
#   rt-host.sh                 says what would change, changes nothing
#   rt-host.sh --apply         changes it; once more changes nothing
#   rt-host.sh --undo          every file as it was before
#   --cpu LIST                 the loop's processors; else the last one with its siblings
#   --root DIR                 a tree elsewhere: its files only, no program is run for it
#
# What is set is in tree/, file by file; programs are run only on this machine: apt-get for the
# kernel, update-grub, systemd-sysusers, udevadm, systemctl, sysctl.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../common.sh"

tree=$root/toolchain/rt-host/tree
kernel=linux-image-rt-amd64
links=(
  "etc/systemd/system/multi-user.target.wants/stylet-rt.service ../stylet-rt.service"
  "etc/systemd/system/irqbalance.service /dev/null" # it would move interrupts back
)

action=plan target="" cpus=""
while [ $# -gt 0 ]; do
  case $1 in
  --apply) action=apply ;;
  --undo) action=undo ;;
  --root) target=$(cd "${2:?--root: expected a folder}" && pwd) && shift ;;
  --cpu) cpus=${2:?--cpu: expected a list of processors} && shift ;;
  --help) sed -n '3,12s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" && exit 0 ;;
  *) die "$1: expected --apply, --undo, --root DIR or --cpu LIST" ;;
  esac
  shift
done
[ "$target" != / ] || target=""
state=$target/var/lib/stylet-rt-host

# ---- processors ---------------------------------------------------------------------------------

# Turns "0-2,5" into "0 1 2 5".
expand() {
  local part
  for part in ${1//,/ }; do seq "${part%-*}" "${part#*-}"; done | paste -sd ' '
}

choose_processors() {
  local folder=$target/sys/devices/system/cpu
  [ -r "$folder/online" ] ||
    die "$folder/online cannot be read: expected the machine's processors there"
  local all last chosen=() other=() cpu
  read -ra all <<<"$(expand "$(cat "$folder/online")")"
  last=${all[-1]}
  [ -n "$cpus" ] || cpus=$(cat "$folder/cpu$last/topology/thread_siblings_list" 2>/dev/null ||
    echo "$last")
  [[ $cpus =~ ^[0-9]+(-[0-9]+)?(,[0-9]+(-[0-9]+)?)*$ ]] ||
    die "--cpu $cpus: expected a list of processors such as 3 or 2-3"
  read -ra chosen <<<"$(expand "$cpus")"
  for cpu in "${chosen[@]}"; do
    [[ " ${all[*]} " == *" $cpu "* ]] ||
      die "processor $cpu is not there: expected some of ${all[*]}"
  done
  for cpu in "${all[@]}"; do [[ " ${chosen[*]} " == *" $cpu "* ]] || other+=("$cpu"); done
  [ ${#other[@]} -gt 0 ] ||
    die "no processor is left for the system: the loop needs one of at least two for itself"
  cpus=$(IFS=, && echo "${chosen[*]}")
  others=$(IFS=, && echo "${other[*]}")
}

# ---- files --------------------------------------------------------------------------------------

files_in() { (cd "$1" && find . ! -type d | sed 's|^\./||' | LC_ALL=C sort); }
paths() { files_in "$tree" && printf '%s\n' "${links[@]%% *}"; }

# make PATH FILE: writes into FILE what PATH is to contain.
make() {
  local each
  for each in "${links[@]}"; do
    if [ "${each%% *}" = "$1" ]; then
      ln -s "${each#* }" "$2"
      return
    fi
  done
  sed "s/@CPUS@/$cpus/g; s/@OTHERS@/$others/g" "$tree/$1" >"$2"
  chmod "$(stat -c %a "$tree/$1")" "$2"
}

exists() { [ -e "$1" ] || [ -L "$1" ]; }

# Whether two files have the same kind, content and mode; links are compared by their targets.
same() {
  exists "$1" && exists "$2" || return 1
  if [ -L "$1" ] || [ -L "$2" ]; then
    [ -L "$1" ] && [ -L "$2" ] && [ "$(readlink "$1")" = "$(readlink "$2")" ]
  else
    cmp -s "$1" "$2" && [ "$(stat -c %a "$1")" = "$(stat -c %a "$2")" ]
  fi
}

# Makes missing folders and records them, the outermost first, so that --undo can remove them.
make_folder() {
  local folder=$1 missing=()
  while [ ! -d "$folder" ]; do
    missing=("${folder#"$target"}" "${missing[@]}")
    folder=$(dirname "$folder")
  done
  [ ${#missing[@]} -gt 0 ] || return 0
  mkdir -p "$1" "$state"
  printf '%s\n' "${missing[@]}" >>"$state/folders"
}

# Puts a new file at a path. Keeps the original in before/ (first time only), the new one in after/.
put() {
  local path=$1
  make_folder "$(dirname "$target/$path")"
  mkdir -p "$state/before/$(dirname "$path")" "$state/after/$(dirname "$path")"
  if ! exists "$state/after/$path" && exists "$target/$path"; then
    cp -a "$target/$path" "$state/before/$path"
  fi
  rm -f "$state/after/$path"
  make "$path" "$state/after/$path"
  local fresh=$target/$path.stylet-new
  cp -d --preserve=mode,links "$state/after/$path" "$fresh"
  mv -fT "$fresh" "$target/$path"
}

take_back() {
  local path=$1
  if ! same "$target/$path" "$state/after/$path"; then
    note "left as it is, because it was changed since: /$path"
    if exists "$state/before/$path"; then
      cp -a "$state/before/$path" "$target/$path.before-stylet"
      note "what it was before is now: /$path.before-stylet"
    fi
    return 0
  fi
  note "back: /$path"
  rm -f "$target/$path"
  if exists "$state/before/$path"; then cp -a "$state/before/$path" "$target/$path"; fi
}

# ---- what only a running machine has ------------------------------------------------------------

here() { [ -z "$target" ]; }
has_kernel() { dpkg-query -W -f='${db:Status-Status}' "$kernel" 2>/dev/null | grep -qx installed; }

run() {
  if command -v "$1" >/dev/null; then
    note "run: $*"
    "$@" >/dev/null || note "failed, see above: $*"
  fi
}

refresh() {
  run systemd-sysusers
  run udevadm control --reload
  run udevadm trigger
  run systemctl daemon-reload
  run update-grub
  run sysctl --system
}

# ---- actions ------------------------------------------------------------------------------------

changes() {
  local path trial
  trial=$(mktemp -d)
  for path in $(paths); do
    make "$path" "$trial/file"
    same "$trial/file" "$target/$path" || echo "$path"
    rm -f "$trial/file"
  done
  rmdir "$trial"
}

plan() {
  say "Processors $cpus for the loop, $others for everything else"
  local path
  for path in $(changes); do
    if exists "$target/$path"; then note "change /$path"; else note "add    /$path"; fi
  done
  if here && ! has_kernel; then note "install $kernel"; fi
}

may_write() {
  [ -w "${target:-/}" ] || die "${target:-/} cannot be written: run as root"
}

apply() {
  may_write
  plan
  local path changed
  changed=$(changes)
  if [ -n "$changed" ]; then
    make_folder "$state"
    for path in $changed; do put "$path"; done
  fi
  if here; then
    has_kernel || run apt-get install -y --no-install-recommends "$kernel"
    [ -z "$changed" ] || refresh
    say "Done. Put your user into the group (adduser USER realtime), boot, then: stylet doctor"
  fi
}

undo() {
  may_write
  [ -d "$state" ] || die "nothing to undo: ${state#"$target"} is not there"
  say "Taking back what was set"
  local path folder
  for path in $(files_in "$state/after"); do take_back "$path"; done
  local folders=""
  [ ! -f "$state/folders" ] || folders=$(tac "$state/folders")
  rm -rf "$state"
  for folder in $folders; do
    [ ! -d "$target$folder" ] || rmdir --ignore-fail-on-non-empty "$target$folder"
  done
  if here; then
    refresh
    note "$kernel and the group realtime stay: apt-get remove $kernel, groupdel realtime"
  fi
}

if [ "$action" = undo ]; then
  undo
  exit 0
fi
choose_processors
if [ "$action" = apply ]; then
  apply
else
  plan
  say "Nothing was changed; --apply does it"
fi
