#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Boots Debian's real-time kernel in software emulation (qemu, no KVM) on a machine that rt-host.sh
# has set up. Shows that stylet doctor recognises the kernel and that the loop runs with SCHED_FIFO.
# Timing is not judged, because every instruction is emulated.
#
#   boot.sh [FOLDER]     where stylet and stylet-organ are; default: build/release/bin
#
# Needs qemu-system-x86; kernel and busybox are downloaded once, to build/rt-host, not installed.
# Exit code 77: some of these are not available on this machine.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../common.sh"

programs=$(realpath "${1:-$root/build/release/bin}")
store=$root/build/rt-host
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

not_here() {
  printf 'skipped: %s\n' "$*"
  exit 77
}

# fetch PACKAGE: downloads a package and unpacks its files into $store/PACKAGE.
fetch() {
  [ ! -d "$store/$1" ] || return 0
  mkdir -p "$store"
  (cd "$work" && apt-get download "$1" >/dev/null 2>&1) || not_here "$1 cannot be downloaded"
  dpkg-deb -x "$work/$1"_*.deb "$store/$1.part"
  mv "$store/$1.part" "$store/$1"
}

# The scene has the longest allowed period: 10 ms a tick.
write_scene() {
  cat <<'SCENE'
[organ]
path = "block.organ"
[loop]
period_us = 10000
[approach]
start_mm = 2
[guard]
watchdog_ms = 5
[[hand.waypoint]]
travel_mm = 10
speed_mm_s = 10
hold_s = 20
SCENE
}

# What the machine does from its start to its end. Each part prints its exit code at its end.
write_init() {
  cat <<'INIT'
#!/bin/sh
mount -t proc none /proc
mount -t sysfs none /sys
mount -t devtmpfs none /dev
mount -t tracefs none /sys/kernel/tracing
sysctl -qp /etc/sysctl.d/70-stylet-rt.conf
/usr/local/lib/stylet/rt-tune 0
echo "== doctor"
stylet doctor
echo "exit code $?"
echo "== run"
stylet run /block.toml --duration-s 3 >/run.txt 2>&1 &
loop=$!
while [ -d /proc/$loop ] && sleep 0.2; do
  # Name, real-time priority and policy of each thread; 1 is SCHED_FIFO.
  cat /proc/$loop/task/*/stat 2>/dev/null | awk '{print $2, "priority", $40, "policy", $41}'
done | sort -u
wait $loop
echo "exit code $?"
cat /run.txt
echo "== end"
poweroff -f
INIT
}

build_image() {
  local image=$work/image busybox=$store/busybox-static/bin/busybox name library
  mkdir -p "$image"/{bin,dev,proc,sys,tmp,etc,usr/local/lib}
  cp "$busybox" "$image/bin/"
  for name in $("$busybox" --list | grep -vx busybox); do ln -s busybox "$image/bin/$name"; done
  cp "$programs/stylet" "$image/bin/"
  for library in $(ldd "$programs/stylet" | grep -o '/[^ ]*'); do
    mkdir -p "$image$(dirname "$library")"
    cp "$library" "$image$library"
  done
  "$programs/stylet-organ" phantom block --size-mm 40,40,40 --voxel-mm 10 \
    -o "$image/block.organ" >/dev/null
  write_scene >"$image/block.toml"
  write_init >"$image/init"
  chmod +x "$image/init"
  # As on a machine with two processors; qemu gets the boot line made for it.
  mkdir -p "$image/sys/devices/system/cpu"
  echo 0-1 >"$image/sys/devices/system/cpu/online"
  "$root/toolchain/rt-host/rt-host.sh" --root "$image" --cpu 1 --apply >/dev/null
  rm -r "$image/sys/devices"
  boot_line=$(GRUB_CMDLINE_LINUX_DEFAULT="" &&
    source "$image/etc/default/grub.d/70-stylet-rt.cfg" && echo "$GRUB_CMDLINE_LINUX_DEFAULT")
  (cd "$image" && find . | "$busybox" cpio -o -H newc 2>/dev/null | gzip -1) >"$work/initrd"
}

boot() {
  timeout 540 qemu-system-x86_64 -accel tcg -cpu max -smp 2 -m 1024 -nic none -nographic \
    -no-reboot -kernel "$store/$kernel"/boot/vmlinuz-* -initrd "$work/initrd" \
    -append "console=ttyS0 quiet panic=-1 $boot_line" </dev/null |
    tr -d '\r\033' | tee "$work/console"
}

# expect WHAT PATTERN: checks that the machine's output contains PATTERN.
expect() {
  if grep -qE "$2" "$work/console"; then
    note "ok: $1"
  else
    note "NOT: $1 (no line matches $2)"
    failed=1
  fi
}

command -v qemu-system-x86_64 >/dev/null || not_here "qemu-system-x86_64 (package qemu-system-x86)"
kernel=$(apt-cache depends linux-image-rt-amd64 2>/dev/null |
  awk '/Depends: linux-image-.*-rt/ {print $2; exit}')
[ -n "$kernel" ] || not_here "the package linux-image-rt-amd64 is not known: apt-get update"
fetch "$kernel"
fetch busybox-static
build_image
say "Booting $kernel: $boot_line"
boot || die "the machine did not come to its end"

say "What it showed"
failed=0
expect "the loop gets the isolated processor" '; processor 1, priority 80$'
expect "doctor sees PREEMPT_RT" '^ok +RT kernel .*PREEMPT_RT'
for check in "real-time priority" "locked memory" isolation "RCU callbacks" workqueues \
  "huge pages" "page merging" compaction "lockup detectors" "timer migration" "idle states" \
  tracing "tasks above the loop"; do
  expect "doctor: $check" "^ok +$check "
done
expect "a thread of the loop has SCHED_FIFO 80" '^\(stylet-loop\) priority 80 policy 1$'
expect "the loop ran its 300 ticks" '^ticks 300,'
[ $failed -eq 0 ] || die "the machine is not what it should be"
