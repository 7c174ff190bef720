#!/usr/bin/env bash
# clang-tidy over every source of Vindu, by .clang-tidy, with the compile commands of the preset
# dev. Arguments are regular expressions that choose sources: tools/tidy.sh core/frustum. Needs a
# configured build (./test).
set -uo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

[[ -f $root/build/dev/compile_commands.json ]] ||
  die "build/dev is not configured: run ./test first."
sources=("$@")
[[ $# -eq 0 ]] && sources=(core tracker cluster renderer simulator app bench tests)
log=$root/build/dev/tidy.log
run-clang-tidy -quiet -p "$root/build/dev" -j "$(jobs)" "${sources[@]/#/^$root/}" \
  >"$log" 2>/dev/null && exit 0
sed 's/\x1b\[[0-9;]*m//g' "$log" | grep -a -E -A4 '(error|warning):'
die "clang-tidy found something; its whole log is build/dev/tidy.log."
