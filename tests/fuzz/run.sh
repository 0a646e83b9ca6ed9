#!/usr/bin/env bash
# Searches for inputs that violate a checked property, with libFuzzer and the stable compiler:
#   tests/fuzz/run.sh TARGET SECONDS [OPTION OF LIBFUZZER ...]     wire, scene_file, hand_path, solver or obstacles
#   tests/fuzz/run.sh build                                        all targets
# New inputs that reach new code go to target/fuzz/found, failing ones to tests/fuzz/artifacts. The corpus is passed file by
# file, sorted by name: the order in which a directory is read differs between machines, and with it the effect of -seed=1.
# Needs: cargo install cargo-fuzz --locked; a C++ compiler
set -euo pipefail
cd "$(dirname "$0")/../.."
# Function names in the stack traces of failures.
export CARGO_PROFILE_RELEASE_STRIP=none
options=(--fuzz-dir tests/fuzz --target-dir target/fuzz --features libfuzzer --sanitizer none)
[ "$1" != build ] || exec cargo fuzz build "${options[@]}"
target=$1 seconds=$2 found=target/fuzz/found/$1 corpus=target/fuzz/$1.corpus words=tests/fuzz/$1.dict
mkdir -p "$found"
printf '%s\n' "tests/fuzz/corpus/$1"/* | LC_ALL=C sort | paste -sd, - >"$corpus"
[ ! -e "$words" ] || set -- "$@" "-dict=$words"
exec cargo fuzz run "${options[@]}" "$target" "$found" -- \
  "-seed_inputs=@$corpus" "-max_total_time=$seconds" -timeout=60 "${@:3}"
