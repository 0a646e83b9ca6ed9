#!/usr/bin/env bash
# The tests of core and of the wire in Miri, which finds what Rust does not define, on a machine that is not like the others: big-endian.
# The interpreter is slow: the tests take fewer samples in it. Needs: rustup toolchain install nightly --component miri,rust-src
set -euo pipefail
cd "$(dirname "$0")/.."
miri() { cargo +nightly miri test --target s390x-unknown-linux-gnu --target-dir target/miri --locked "$@"; }
miri -p stiction-core
miri -p stiction-tests --test wire
