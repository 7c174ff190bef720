#!/usr/bin/env bash
# Builds the fuzzers with clang's libFuzzer and lets each search for a while:
#   tests/fuzz/run.sh [SECONDS] [NAME...]        (default 60 wiimote recording wire scene)
# What one finds is left in build/fuzz/NAME as crash-...; give that file to its program to see it
# again.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
seconds=${1:-60}
names=("${@:2}")
[[ ${#names[@]} -gt 0 ]] || names=(wiimote recording wire scene)

# fuzz NAME LENGTH COMPILER-ARGUMENT...: tests/fuzz/NAME_fuzz.cpp on inputs of up to LENGTH bytes.
fuzz() {
  local folder=$root/build/fuzz/$1 program=$1_fuzz source=$root/tests/fuzz/$1_fuzz.cpp length=$2
  mkdir -p "$folder/corpus"
  clang++ -std=c++20 -O1 -g -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=all \
    -I"$root" "$source" "${@:3}" -o "$folder/$program"
  cd "$folder"
  "./$program" -max_total_time="$seconds" -max_len="$length" -print_final_stats=1 -verbosity=0 \
    corpus
}

wiimote() {
  fuzz wiimote 512 \
    "$root"/tracker/wiimote/{acceleration,commands,drought,exchange}.cpp \
    "$root"/tracker/wiimote/{gaps,halves,report,session}.cpp \
    "$root/core/infrared.cpp" -isystem /usr/include/eigen3 -lfmt
}

# Seeded with a good text, and with bodies of a start record and a report.
recording() {
  local corpus=$root/build/fuzz/recording/corpus
  mkdir -p "$corpus"
  printf '\0# a text\nleft 1000 33 00 40 80\nright 2000 20 00\n' > "$corpus/text"
  {
    printf '\1\43\0\1' && head -c 34 /dev/zero
    printf '\17\0\2\0\0\1\0\0\0\0\0\0\0\63\0\100\200'
  } > "$corpus/bodies"
  fuzz recording 8192 "$root"/tracker/recording_{format,reader,stream}.cpp "$root/core/error.cpp" \
    -isystem /usr/include/eigen3 -lz
}

# Seeded with good messages; the wire's C structs are generated as the build does it.
wire() {
  local generated=$root/build/fuzz/wire/generated
  mkdir -p "$generated"
  idlc -o "$generated" "$root/cluster/wire.idl"
  clang -O1 -g -fsanitize=fuzzer-no-link,address,undefined -c "$generated/wire.c" \
    -o "$generated/wire.o"
  clang++ -std=c++20 -I"$root" -isystem /usr/include/eigen3 \
    "$root"/tests/{fuzz/wire_seeds,cluster/random_messages}.cpp "$root"/cluster/{cdr,topics}.cpp \
    "$root/cluster/internal/wire_types.cpp" -I"$generated" "$generated/wire.o" \
    "$root/core/frame_state.cpp" -fsanitize=address,undefined -lddsc -o "$generated/seeds"
  mkdir -p "$root/build/fuzz/wire/corpus"
  "$generated/seeds" "$root/build/fuzz/wire/corpus"
  fuzz wire 4096 -I"$generated" -isystem /usr/include/eigen3 "$root"/cluster/{cdr,topics}.cpp \
    "$root"/cluster/internal/{participant_text,wire_types}.cpp \
    "$root"/core/{error,frame_state}.cpp "$generated/wire.o" -lddsc
}

# Seeded with good scenes.
scene() {
  local sources=("$root"/renderer/{mipmaps,packed_scene,scene,scene_file,skinning,surface_kind}.cpp
    "$root"/core/{error,new_file}.cpp -isystem /usr/include/eigen3 -lstb)
  mkdir -p "$root/build/fuzz/scene/corpus"
  clang++ -std=c++20 -I"$root" "$root/tests/fuzz/scene_seeds.cpp" "${sources[@]}" \
    -o "$root/build/fuzz/scene/seeds"
  "$root/build/fuzz/scene/seeds" "$root/build/fuzz/scene/corpus"
  fuzz scene 8192 "${sources[@]}"
}

for name in "${names[@]}"; do
  "$name"
done
