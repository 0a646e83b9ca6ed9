#!/usr/bin/env bash
# Checks that take too long for every change: the tests of the computing packages in a release build, a thousand million steps of the
# hand, a million frames on every machine and of random drags on the Pico, a hundred thousand over a faulty line to the boards, and an
# hour of fuzzing for each target.
set -euo pipefail
cd "$(dirname "$0")/.."
export STICTION_TESTS=long
cargo test --release --locked -p stiction-core -p stiction-wire -p stiction-firmware -p stiction-scene -p stiction-tests
cargo run --release --locked -p stiction-tests --example walk -- 1000000000
cargo test --locked -p stiction-lab --test emulated --test firmware -- --ignored --skip table
for target in wire scene_file hand_path solver obstacles; do tests/fuzz/run.sh "$target" 3600; done
