#!/usr/bin/env bash
# Changes the code of core and of the wire in one place at a time (cargo-mutants) and lists the changes that no test notices: first with
# the quick tests, then, for the changes that survive these, with all tests. Takes hours. Arguments are passed to cargo
# mutants, for example `--jobs 2` or `--file core/src/search.rs`; the results are in target/mutants/mutants.out.
# Needs: cargo install cargo-mutants cargo-nextest --locked
set -euo pipefail
cd "$(dirname "$0")/.."
export RUST_BACKTRACE=0 PROPTEST_MAX_SHRINK_ITERS=0 CARGO_INCREMENTAL=1
mkdir -p target/mutants
mutants() {
  local status=0
  # The time of the unmutated tests is measured on core's own tests alone; nextest ends tests that hang.
  cargo mutants --package stiction-core --package stiction-wire --test-package stiction-core,stiction-tests,stiction-wire \
    --test-tool nextest --profile mutants --output target/mutants --no-shuffle --timeout 1200 "$@" || status=$?
  # 2 and 3: mutants were missed, or timed out.
  [ $status = 0 ] || [ $status = 2 ] || [ $status = 3 ] || exit $status
}
export NEXTEST_PROFILE=mutants-quick
mutants "$@"
rm -rf target/mutants/quick.out
cp -r target/mutants/mutants.out target/mutants/quick.out
NEXTEST_PROFILE=mutants
mutants --iterate "$@"
