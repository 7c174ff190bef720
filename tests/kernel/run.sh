#!/usr/bin/env bash
# Runs a program under Debian's own kernel, emulated by QEMU, as root and with the modules that it
# wants: what the machine that tests need not have. The kernel is unpacked, never installed; the
# file system is the program, its libraries, those modules and busybox, in memory.
set -euo pipefail

usage() {
  cat <<'END'
usage: run.sh MODULES PROGRAM LINUX FOLDER [FILE...]

  MODULES  of the kernel, that are loaded before: "uhid hid-wiimote"
  PROGRAM  what runs in there; its exit code becomes this script's
  LINUX    the unpacked package of a kernel: LINUX/boot/vmlinuz-*, LINUX/lib/modules/*
  FOLDER   where the file system is made
  FILE     files that the program reads, under the same names in there; with a library's own
END
}

die() {
  printf 'tests/kernel/run.sh: %s\n' "$*" >&2
  exit 1
}

limit_s=280

need_tools() {
  local tool
  for tool in qemu-system-x86_64:qemu-system-x86 busybox:busybox-static; do
    command -v "${tool%:*}" >/dev/null ||
      die "there is no ${tool%:*}; install the Debian package ${tool#*:}"
  done
  [[ -f $vmlinuz ]] || die "$linux: holds no kernel; ./test --full fetches Debian's and unpacks" \
    "it there"
}

# in_there FILE...: a copy of each under its own name, links followed.
in_there() {
  local file
  for file; do install -D "$file" "$stage$file"; done
}

add_program() {
  install -D "$program" "$stage/program"
  local file libraries
  mapfile -t libraries < <(for file in "$program" "$@"; do
    [[ $file == *.so || $file == "$program" ]] && ldd "$file"
  done | grep -o '/[^ ]*[^ :]' | sort -u)
  in_there "${libraries[@]}" "$@"
}

# The modules and what they need; the other 4,000 stay outside. What the kernel has built in is no
# file, and needs none.
add_modules() {
  local from=$linux/lib/modules/$release to=$stage/lib/modules/$release module file
  [[ -f $from/modules.dep ]] || busybox depmod -b "$linux" "$release"
  mkdir -p "$to"
  cp "$from"/modules.{builtin,order} "$to"
  for module in $modules; do
    for file in $(sed -n "s|:| |; \\|/$module\\.ko |p" "$from/modules.dep"); do
      install -D "$from/$file" "$to/$file"
    done
  done
  busybox depmod -b "$stage" "$release"
}

add_init() {
  mkdir -p "$stage"/{bin,proc,sys,dev,tmp}
  install "$(command -v busybox)" "$stage/bin"
  cat >"$stage/init" <<END
#!/bin/busybox sh
/bin/busybox --install -s /bin
mount -t proc proc /proc
mount -t sysfs sys /sys
mount -t devtmpfs dev /dev
for module in $modules; do modprobe \$module || echo "no module \$module"; done
TERM=dumb /program
echo "exit code \$?"
poweroff -f
END
  chmod +x "$stage/init"
}

make_file_system() {
  rm -rf "$stage"
  add_program "$@"
  add_modules
  add_init
  (cd "$stage" && find . | busybox cpio -o -H newc 2>/dev/null) >"$folder/initramfs"
  rm -rf "$stage"
}

# No KVM: it is not there where tests run, and emulation is the same everywhere.
boot() {
  local memory_mb=$((768 + 4 * $(stat -c %s "$folder/initramfs") / 1000000))
  timeout "$limit_s" qemu-system-x86_64 -accel tcg -cpu max -smp 2 -m "$memory_mb" -nodefaults \
    -display none -serial stdio -no-reboot -kernel "$vmlinuz" -initrd "$folder/initramfs" \
    -append "console=ttyS0 quiet panic=-1 random.trust_cpu=on" </dev/null
}

[[ $# -ge 4 ]] || {
  usage >&2
  exit 2
}
modules=$1 program=$2 linux=$3 folder=$4
shift 4
vmlinuz=$(compgen -G "$linux/boot/vmlinuz-*" | head -n 1 || true)
release=${vmlinuz##*/vmlinuz-}
stage=$folder/files
need_tools
mkdir -p "$folder"
make_file_system "$@"
status=0
boot | tr -d '\r' | tee "$folder/serial.log" || status=$?
code=$(sed -n 's/^exit code //p' "$folder/serial.log" | tail -n 1)
[[ -n $code ]] || die "the kernel did not come to its end (QEMU: $status, 124 is $limit_s s);" \
  "what it said: $folder/serial.log"
exit "$code"
