#!/usr/bin/env bash
# Looks for bytes for which something does not hold, with libFuzzer and the stable compiler:
#   tests/fuzz/run.sh TARGET SECONDS [OPTION OF LIBFUZZER ...]     wire, scene_file, hand_path or solver
#   tests/fuzz/run.sh build                                        all targets
# Inputs that go through new code are put into target/fuzz/found, those that fail into tests/fuzz/artifacts.
# Needs: cargo install cargo-fuzz --locked; a C++ compiler
set -euo pipefail
cd "$(dirname "$0")/../.."
options=(--fuzz-dir tests/fuzz --target-dir target/fuzz --features libfuzzer --sanitizer none)
[ "$1" != build ] || exec cargo fuzz build "${options[@]}"
target=$1 seconds=$2 found=target/fuzz/found/$1 words=tests/fuzz/$1.dict
mkdir -p "$found"
[ ! -e "$words" ] || set -- "$@" "-dict=$words"
exec cargo fuzz run "${options[@]}" "$target" "$found" "tests/fuzz/corpus/$target" -- \
  "-max_total_time=$seconds" -timeout=60 "${@:3}"
