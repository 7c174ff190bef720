#!/usr/bin/env bash
# Builds the fuzzer of the Wiimote's driver with clang's libFuzzer and lets it search for a while:
#   tests/fuzz/run.sh [SECONDS]        (default 60)
# What it finds is left in build/fuzz as crash-...; give that file to the program to see it again.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
folder=$root/build/fuzz
mkdir -p "$folder/corpus"
sources=("$root"/tracker/wiimote/{commands,exchange,gaps,report,sensitivity,session}.cpp)
clang++ -std=c++20 -O1 -g -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=all \
  -I"$root" "$root/tests/fuzz/wiimote_fuzz.cpp" "${sources[@]}" -lfmt -o "$folder/wiimote_fuzz"
cd "$folder"
./wiimote_fuzz -max_total_time="${1:-60}" -max_len=512 -print_final_stats=1 -verbosity=0 corpus
