#!/usr/bin/env bash
# Runs every check: format, lints, tests, the live page in a browser, documentation, bare-metal builds, oldest
# compiler, dependencies.
#   tests/check.sh             all checks
#   tests/check.sh --quick     format, lints, and the tests of the code that changes most often: core, tests, scene files
# If an optional tool is missing and cannot be installed, the stage is skipped and the command to install it is
# printed; with CI=true, a missing tool is a failure.
set -euo pipefail
cd "$(dirname "$0")/.."

# Incremental compilation and debug information take gigabytes and minutes, and are of no use to a checkout that is built only once.
[ "${CI:-}" != true ] || export CARGO_INCREMENTAL=0 CARGO_PROFILE_DEV_DEBUG=0

quick=
case "$*" in
  '') ;;
  --quick) quick=yes ;;
  *)
    printf 'unknown argument: %s; allowed: --quick, or none\n' "$*" >&2
    exit 2
    ;;
esac

stage() { printf '\n== %s (after %d min %02d s)\n' "$*" $((SECONDS / 60)) $((SECONDS % 60)); }

# missing WHAT COMMAND: skips the stage, or fails if CI=true.
missing() {
  printf 'missing: %s; to install it: %s\n' "$1" "$2"
  [ "${CI:-}" != true ]
}

stage 'format'
cargo fmt --all --check
cargo fmt --check --manifest-path firmware/template/Cargo.toml

stage 'lints'
cargo clippy --workspace --all-targets --locked -- -D warnings

if [ -n "$quick" ]; then
  stage 'tests of core, tests and scene files'
  cargo test --no-fail-fast --locked -p stiction-core -p stiction-scene -p stiction-tests
  stage 'the quick checks passed; to run all checks: tests/check.sh'
  exit
fi

stage 'core and firmware on bare metal'
# One cargo for all targets keeps all cores busy.
has_target() { rustup target list --installed 2>/dev/null | grep -qx "$1"; }
boards=() targets=()
for target in thumbv7em-none-eabihf thumbv6m-none-eabi thumbv8m.main-none-eabihf riscv32imc-unknown-none-elf wasm32-unknown-unknown; do
  if has_target "$target" || rustup target add "$target"; then
    targets+=(--target "$target")
    [ "$target" = wasm32-unknown-unknown ] || boards+=(--target "$target")
  else
    missing "target $target" "rustup target add $target"
  fi
done
[ ${#targets[@]} = 0 ] || cargo build -p stiction-core --profile device --locked "${targets[@]}"
[ ${#boards[@]} = 0 ] || cargo clippy -p stiction-firmware --features board --locked "${boards[@]}" -- -D warnings

# on TARGET BOARD FEATURES...: the lints of a board's program, once with each set of features, `none` included.
on() {
  local target=$1 board=$2 features
  shift 2
  has_target "$target" || return 0
  for features in "$@"; do
    cargo clippy -p stiction-boards --lib --bin "stiction-$board" --no-default-features --features "$board,${features#none}" --locked --target "$target" -- -D warnings
  done
}
on thumbv7em-none-eabihf olimex-stm32-h405 none rtt semihosting rtt,pantograph
on thumbv6m-none-eabi microbit none rtt semihosting
on thumbv6m-none-eabi pico none rtt rtt,knob rtt,pantograph
# This board's only log is that of its emulator.
on thumbv8m.main-none-eabihf mps2-an505 none semihosting
on thumbv8m.main-none-eabihf pico2 none rtt rtt,knob rtt,pantograph

stage 'emulators and interpreters'
# QEMU supports both boards since version 10, which Debian 12 has in its backports: on the mirror from which the machine takes
# its packages.
suite=
if grep -qs '^VERSION_CODENAME=bookworm$' /etc/os-release; then
  suite='-t bookworm-backports '
  backports=/etc/apt/sources.list.d/bookworm-backports.list
fi
add_backports() {
  local mirror
  mirror=$(apt-get indextargets --format '$(RELEASE) $(COMPONENT) $(REPO_URI)' 'Created-By: Packages' |
    sed -n 's/^bookworm main //p' | head -n 1)
  [ -z "$mirror" ] || printf 'deb %s bookworm-backports main\n' "$mirror" >"$backports"
}
version() { "$1" --version 2>/dev/null | sed -n '1s/.* version \([0-9]*\)\..*/\1/p'; }
for tool in qemu-system-arm:qemu-system-arm qemu-system-riscv32:qemu-system-misc node:nodejs python3:python3 c++:g++ 'clang:clang libclang-rt-dev' 'cmake:cmake make'; do
  program=${tool%:*} from=
  case $program in
    qemu-*)
      from=$suite
      [ "$(version "$program")" -ge 10 ] 2>/dev/null && continue
      [ -z "$suite" ] || apt-cache policy | grep -q bookworm-backports || add_backports || true
      ;;
    *) command -v "$program" && continue ;;
  esac
  install="apt-get install -y --no-install-recommends $from${tool#*:}"
  { apt-get update && $install; } || missing "$program${from:+, from the suite bookworm-backports}" "$install"
done

for tool in flip-link defmt-print; do
  command -v "$tool" || cargo install "$tool" --locked || missing "$tool" "cargo install $tool"
done

stage 'images of emulated boards'
# A single cargo builds all images on all cores; the tests that run them would build them one after
# the other.
if [ ${#boards[@]} != 0 ]; then
  cargo build -p stiction-firmware --profile device --features board --bin 'count_*' --bin 'bits_f*' --bin 'footprint*' \
    --locked "${boards[@]}"
  # The images with obstacles are built for small flash: the smallest chip has no more.
  cargo build -p stiction-firmware --profile device-small --features board --bin 'bits_among_*' --locked "${boards[@]}"
fi

# beside LOG COMMAND: runs the command in parallel with the following stages, at lower priority.
mkdir -p target
beside() {
  local log=target/$1.log
  shift
  (
    renice -n 10 -p "$BASHPID" >/dev/null || true
    "$@"
  ) >"$log" 2>&1 &
}
# shown LOG PROCESS: waits for the process to end; if it failed, prints its output.
shown() {
  wait "$2" || {
    tail -n 60 "target/$1.log"
    return 1
  }
}

# Tools that take minutes to compile, in parallel with the build of the tests, which does not always use all cores. Nothing else runs
# in parallel: the emulated boards must keep time.
installs() {
  local tool
  for tool in deny fuzz; do
    cargo "$tool" --version || env -u CARGO_TARGET_DIR cargo install "cargo-$tool" --locked
  done
}
beside cargo-tools installs
installs=$!

stage 'tests'
# The tests run with debug assertions and overflow checks. Some of them check, by the bits of all answers, that a release build computes
# the same; the nightly run repeats the tests in a release build. Of the examples only the walk is built, which runs below; the lints have
# checked the others. One build of all programs and tests shares every dependency; a package built alone would need some of them
# with other features.
cargo build --workspace --exclude stiction-bench --locked --lib --bins --tests --example walk
built=${CARGO_TARGET_DIR:-target}/debug
cargo test --no-fail-fast --workspace --exclude stiction-bench --locked --lib --bins --tests
cargo test --no-fail-fast --workspace --exclude stiction-bench --locked --doc

# The page and the Python package leave a core free for the fuzz targets, the oldest compiler, and a walk.
has_fuzz() { command -v c++ && cargo fuzz --version; } >/dev/null 2>&1
oldest=$(sed -n 's/^rust-version = "\(.*\)"/\1/p' Cargo.toml)
oldest_checks() {
  cargo "+$oldest" --version 2>/dev/null || rustup toolchain install "$oldest" --profile minimal || {
    missing "Rust $oldest" "rustup toolchain install $oldest --profile minimal"
    return
  }
  cargo "+$oldest" check -p stiction-core -p stiction-host-sim --no-default-features --locked --target-dir "target/rust-$oldest"
}
wait "$installs" || true
others() {
  if has_fuzz; then tests/fuzz/run.sh build; fi
  oldest_checks
  "$built/examples/walk" 10000000
}
beside others others
others=$!

stage 'the live page'
# The page is tested in Node.js 20 or newer and in Chromium; its tools and playwright come from a
# lock file.
has_node() { command -v npm && [ "$(node -p 'process.versions.node.split(".")[0]')" -ge 20 ]; } >/dev/null 2>&1
has_browser() {
  [ -n "${CHROMIUM:-}" ] || command -v chromium || command -v chromium-browser || command -v google-chrome
}
# If the distribution's Node.js is older, npm provides a newer one.
node='apt-get install -y --no-install-recommends nodejs npm && npm install --global node@22'
browser='apt-get install -y --no-install-recommends chromium fonts-dejavu-core'
has_node || { apt-get update && eval "$node" && hash -r; } || true
has_browser || { apt-get update && $browser; } || true
if ! has_node; then
  missing 'Node.js 20 or newer with npm' "$node"
elif ! has_browser; then
  missing 'Chromium' "$browser"
elif ! npm ci --prefix host-sim/tests/web --no-audit --no-fund; then
  missing 'the packages for the tests of the page' 'npm ci --prefix host-sim/tests/web'
else
  npm run --prefix host-sim/tests/web check
  # The page without a server and the npm package, which the tests below examine.
  if rustup target add wasm32-unknown-unknown; then
    "$built/stiction-page" --out "${CARGO_TARGET_DIR:-target}/page" --npm "${CARGO_TARGET_DIR:-target}/npm"
    cargo build --release --locked -p stiction-live --features obstacles --example bits
  else
    missing 'the target wasm32-unknown-unknown' 'rustup target add wasm32-unknown-unknown'
  fi
  node --test --test-concurrency=1 host-sim/tests/web/*.test.js
fi

stage 'the Python package'
# The package is built with debug assertions and overflow checks, from the artifacts of the tests above, and installed into its own
# environment; its tests compare it with the program.
venv='apt-get install -y --no-install-recommends python3-venv'
python3 -c 'import ensurepip' 2>/dev/null || { apt-get update && $venv; } || true
if ! python3 -c 'import ensurepip' 2>/dev/null; then
  missing 'the Python module venv' "$venv"
elif ! { python3 -m venv target/python && target/python/bin/pip install -q -r host-sim/python/tests/requirements.txt; }; then
  missing 'the packages for the tests of the Python package' 'target/python/bin/pip install -r host-sim/python/tests/requirements.txt'
else
  rm -rf target/wheels
  target/python/bin/maturin build --locked -m host-sim/python/Cargo.toml --out target/wheels
  target/python/bin/pip install -q --force-reinstall --no-deps target/wheels/*.whl
  target/python/bin/python -m pytest -q host-sim/python
fi

stage "the oldest compiler, $oldest, and ten million steps of the hand"
shown others "$others"
tail -n 5 target/others.log

stage 'fuzzing, a minute for each target'
# The inputs are the same on every machine, and no more on a fast one, so that a change does not fail by chance. The option
# use_cmp is off because it tries numbers that the program compares, which include addresses. The nightly run searches with
# another seed each time. The runtime of libFuzzer is written in C++.
fuzz_for_a_minute() {
  local log=target/fuzz/$1.log
  rm -rf "target/fuzz/found/$1"
  tests/fuzz/run.sh "$1" 60 -seed=1 "-runs=$2" -use_cmp=0 >"$log" 2>&1 || {
    grep -a -m 1 -A 4 'panicked at' "$log" | cut -c 1-500 || true
    tail -n 20 "$log"
    return 1
  }
  printf '%s: %s\n' "$1" "$(grep -a '^Done' "$log")"
}
if ! command -v c++ >/dev/null; then
  missing 'a C++ compiler' 'apt-get install -y --no-install-recommends g++'
elif has_fuzz; then
  fuzz_for_a_minute wire 600000 & wire=$!
  fuzz_for_a_minute solver 6000
  wait $wire
  fuzz_for_a_minute scene_file 1300000 & scene_file=$!
  fuzz_for_a_minute hand_path 9000000
  wait $scene_file
  fuzz_for_a_minute obstacles 4000
else
  tail -n 20 target/cargo-tools.log
  missing cargo-fuzz 'cargo install cargo-fuzz --locked'
fi

stage 'documentation'
RUSTDOCFLAGS='-D warnings' cargo doc --workspace --no-deps --locked

# as_database ARCHIVE: makes cargo-deny fetch its database from the files of this archive.
as_database() {
  local files=$PWD/target/advisory-snapshot
  rm -rf "$files"
  mkdir -p "$files"
  tar -xzf "$1" -C "$files"
  git -C "$files" init -q -b main
  git -C "$files" add -A -f
  git -C "$files" -c user.name=snapshot -c user.email= commit -q -m "$(basename "$1")"
  GIT_CONFIG_COUNT=1 GIT_CONFIG_KEY_0="url.file://$files.insteadOf" GIT_CONFIG_VALUE_0=https://github.com/RustSec/advisory-db \
    cargo deny --locked fetch db
}

stage 'dependencies: licences, sources, duplicates'
if cargo deny --version; then
  cargo deny --locked check licenses bans sources

  stage 'dependencies: known vulnerabilities'
  # The database from the network, or, if that cannot be reached, a snapshot of it next to the checkout.
  snapshot=$(printf '%s\n' ../shared/data/advisory-db-*.tar.gz | tail -n 1)
  if cargo deny --locked fetch db; then
    cargo deny --locked --offline check advisories
  elif [ -e "$snapshot" ]; then
    printf 'the database of vulnerabilities cannot be fetched; its snapshot is used: %s\n' "$(basename "$snapshot")"
    as_database "$snapshot"
    cargo deny --locked --offline check advisories
  else
    missing 'the database of vulnerabilities' 'cargo deny fetch db'
  fi
else
  tail -n 20 target/cargo-tools.log
  missing cargo-deny 'cargo install cargo-deny --locked'
fi

stage 'all checks passed'
