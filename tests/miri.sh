#!/usr/bin/env bash
# Runs the tests of core and of the wire in Miri, which detects undefined behaviour, on a big-endian machine, unlike the usual ones. The
# interpreter is slow, so the tests take fewer samples. Needs: rustup toolchain install nightly --component miri,rust-src
set -euo pipefail
cd "$(dirname "$0")/.."
miri() { cargo +nightly miri test --target s390x-unknown-linux-gnu --target-dir target/miri --locked "$@"; }
miri -p stiction-core -p stiction-wire
miri -p stiction-tests --test wire
