#!/usr/bin/env bash
# Changes the code of core in one place after the other (cargo-mutants) and lists the changes that no test notices: first
# with the quick tests, then, what these let live, with all. Takes hours. Arguments go to cargo mutants, as `--jobs 2` or
# `--file core/src/search.rs`; what is found is in target/mutants/mutants.out.
# Needs: cargo install cargo-mutants cargo-nextest --locked
set -euo pipefail
cd "$(dirname "$0")/.."
export RUST_BACKTRACE=0 PROPTEST_MAX_SHRINK_ITERS=0 CARGO_INCREMENTAL=1
mkdir -p target/mutants
mutants() {
  local status=0
  # The time of the unmutated tests is taken of core's own alone; the tests that hang are ended by nextest.
  cargo mutants --package stiction-core --test-package stiction-core,stiction-tests --test-tool nextest --profile mutants \
    --output target/mutants --no-shuffle --timeout 1200 "$@" || status=$?
  # 2 and 3: mutants were missed, or timed out.
  [ $status = 0 ] || [ $status = 2 ] || [ $status = 3 ] || exit $status
}
export NEXTEST_PROFILE=mutants-quick
mutants "$@"
rm -rf target/mutants/quick.out
cp -r target/mutants/mutants.out target/mutants/quick.out
NEXTEST_PROFILE=mutants
mutants --iterate "$@"
