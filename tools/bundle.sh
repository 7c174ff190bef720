#!/usr/bin/env bash
# The renderer's benches and tests, the program, and all that they load, as one file: for a machine
# with a GPU on which nothing can be installed.
#   tools/bundle.sh vindu.tar.xz
# There, which needs no more than the GPU's driver and a C library of Debian 12 or newer:
#   tar xf vindu.tar.xz
#   vindu/run limits_bench
#   vindu/run renderer_gl_test
#   vindu/run vindu doctor
# Tests and frame_lock_bench look where they were built: make that folder a link to vindu/ there.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

[[ $# -eq 1 && $1 != -* ]] || {
  sed -n '2,/^set/{/^set/!s/^# \?//p}' "${BASH_SOURCE[0]}" >&2
  exit 2
}
out=$(realpath "$1")
programs=(app/vindu bench/{limits,detail,tiles,renderer,frame_lock}_bench
  tests/renderer/renderer_gl_test tests/golden/golden_test tests/closed_loop/closed_loop_test)
build dev "${programs[@]##*/}"

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
bundle=$folder/vindu
mkdir -p "$bundle/lib"
for program in "${programs[@]}"; do
  mkdir -p "$bundle/build/dev/${program%/*}"
  strip -o "$bundle/build/dev/$program" "$root/build/dev/$program"
done
# All but the C library, which is the machine's; EGL's and OpenGL's front ends, which find the
# machine's driver, are loaded by libepoxy when they are called.
front=(/usr/lib/*/lib{EGL,OpenGL,GLX,GLdispatch,GL}.so.[0-9])
{
  ls "${front[@]}"
  ldd "${programs[@]/#/$root/build/dev/}" "${front[@]}" | awk '$2 == "=>" { print $3 }'
} | grep -Ev '/(libc|libm|libdl|librt|libpthread|libresolv)\.so' | sed 's|.*/lib/|/usr/lib/|' |
  sort -u | xargs cp -Lt "$bundle/lib"
(cd "$root" && cp -r --parents shaders assets tests/golden/*.png "$bundle")
mkdir "$bundle/fonts"
cp /usr/share/fonts/truetype/dejavu/DejaVuSans{,-Bold}.ttf "$bundle/fonts"
cat >"$bundle/run" <<'RUN'
#!/bin/sh
# run PROGRAM [ARGUMENT...]: one of the bundle, by its name.
here=$(cd "$(dirname "$0")" && pwd)
program=$(find "$here/build" -type f -name "${1:?which program?}")
shift
export LD_LIBRARY_PATH="$here/lib" VINDU_DATA="$here"
exec "${program:?is not in this bundle}" "$@"
RUN
chmod +x "$bundle/run"
XZ_DEFAULTS="--threads=0" tar -C "$folder" -cJf "$out" vindu
say "$(du -h "$out" | cut -f1) in $out"
