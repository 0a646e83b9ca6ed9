#!/usr/bin/env bash
# Checks the tree.
#   tests/check.sh           what a change has to pass
#   tests/check.sh --all     adds all chips and feature sets, emulated boards at length, C, Python, all of the page, fuzzing, the oldest
#                            compiler, the compilers of other systems, and dependencies with known vulnerabilities
#   tests/check.sh --quick   format, shapes, and lints and tests of core
# It installs what it needs where it may. Where an optional tool is missing and cannot be installed, its part is skipped and the command that
# installs it is printed; with CI=true, a missing tool is a failure. The times of all parts and test programs are printed at the end.
# What takes still longer is in nightly.sh.
set -euo pipefail
cd "$(dirname "$0")/.."
. tests/needs.sh

mode=change
case "$*" in
  '') ;;
  --all) mode=all ;;
  --quick) mode=quick ;;
  *)
    printf 'unknown argument: %s; allowed: --all, --quick, or none\n' "$*" >&2
    exit 2
    ;;
esac
is_all() { [ $mode = all ]; }

# Incremental compilation and debug information take gigabytes and minutes.
export CARGO_INCREMENTAL=0 CARGO_PROFILE_DEV_DEBUG=0
target=${CARGO_TARGET_DIR:-target} built=${CARGO_TARGET_DIR:-target}/debug
logs=target/checks
mkdir -p $logs
: >$logs/times
: >$logs/tests.log

# The goals, which the times at the end are to be compared with.
case $mode in
  quick) printf 'Is to take a minute once the tests are built. Installs nothing.\n' ;;
  change)
    printf 'Is to take 15 minutes on two cores, 5 once everything is built, and what downloads take.\n'
    printf 'Installs, where they are missing: a target of Rust, QEMU, Node.js, Chromium.\n'
    ;;
  all)
    printf 'Is to take 45 minutes on two cores, and what downloads take.\n'
    printf 'Installs, where they are missing: targets of Rust and the oldest compiler, QEMU, Node.js, Chromium, Python packages,\n'
    printf 'compilers for C, flip-link, defmt-print, cargo-deny, cargo-fuzz.\n'
    ;;
esac

part= begun=0
end_part() { [ -z "$part" ] || printf '%5d s  %s\n' $((SECONDS - begun)) "$part" >>$logs/times; }
part() {
  end_part
  part=$* begun=$SECONDS
  printf '\n== %s (after %d min %02d s)\n' "$part" $((SECONDS / 60)) $((SECONDS % 60))
}
# The times, also where a part has failed.
report() {
  local status=$?
  end_part
  kill $(jobs -p) 2>/dev/null || true
  printf '\n== times\n'
  cat $logs/times
  awk '/^ +Running /{ sub(/^ +Running (unittests )?/, ""); name = $0 }
    /finished in/{ match($0, /finished in [0-9.]+/); printf "%7.1f s  %s\n", substr($0, RSTART + 12, RLENGTH - 12), name }' \
    $logs/tests.log | sort -rn | head -n 25 >$logs/programs
  [ ! -s $logs/programs ] || { printf '== the slowest test programs\n' && cat $logs/programs; }
  if [ $status = 0 ]; then printf '== all checks passed in %d s\n' $SECONDS; else printf '== FAILED: %s\n' "$part"; fi
}
trap report EXIT

# cargo_test ARGUMENTS: the tests, with the time of each program.
cargo_test() { cargo test --no-fail-fast --locked "$@" 2>&1 | tee -a $logs/tests.log; }

# beside LOG COMMAND: runs the command in parallel with the following parts, at lower priority. shown LOG PROCESS waits for it to end; if
# it failed, its output is printed.
beside() {
  local log=$logs/$1.log
  shift
  (
    trap - EXIT
    renice -n 10 -p "$BASHPID" >/dev/null || true
    "$@"
  ) >"$log" 2>&1 &
}
shown() {
  wait "$2" || {
    tail -n 60 "$logs/$1.log"
    return 1
  }
}

part 'format, shapes and words'
cargo fmt --all --check
# Its sources of stiction lie where its copy expects them, so cargo cannot read its manifest here.
rustfmt --check --edition 2024 firmware/template/{build,src/main,src/embassy}.rs
python3 tests/shape.py

if [ $mode = quick ]; then
  part 'lints and tests of core'
  cargo clippy --locked -p stiction-core --all-targets -- -D warnings
  cargo_test -p stiction-core --lib
  exit
fi

if is_all; then
  # They take minutes to compile, while one core is often idle.
  tools() { for tool in cargo-deny cargo-fuzz; do cargo_needs $tool || true; done; }
  beside tools tools
  tools=$!
fi

# What the lints, the tests and the documentation are of.
packages=(--workspace)
if ! is_all; then
  for package in boards c fuzz lab page python wasm; do packages+=(--exclude stiction-$package); done
fi

part 'lints'
cargo clippy "${packages[@]}" --all-targets --locked -- -D warnings

part 'core on bare metal'
chips=(thumbv7em-none-eabihf)
! is_all || chips+=(thumbv6m-none-eabi thumbv8m.main-none-eabihf riscv32imc-unknown-none-elf)
boards=()
for chip in "${chips[@]}"; do
  ! target_needs $chip || boards+=(--target $chip)
done
if [ ${#boards[@]} != 0 ]; then
  # One cargo for all targets keeps all cores busy.
  cargo build -p stiction-core -p stiction-wire --profile device --locked "${boards[@]}"
  cargo clippy -p stiction-firmware --features board --locked "${boards[@]}" -- -D warnings
fi

# on TARGET BOARD FEATURES...: the lints of a board's program, once with each set of features, `none` included.
on() {
  local chip=$1 board=$2 features
  shift 2
  has_target $chip || return 0
  for features in "$@"; do
    cargo clippy -p stiction-boards --lib --bin "stiction-$board" --no-default-features --features "$board,${features#none}" --locked \
      --target $chip -- -D warnings
  done
}
if is_all; then
  part 'boards with each set of features'
  on thumbv7em-none-eabihf olimex-stm32-h405 none rtt semihosting rtt,pantograph
  on thumbv6m-none-eabi microbit none rtt semihosting
  on thumbv6m-none-eabi pico none rtt rtt,knob rtt,pantograph
  # This board's only log is that of its emulator.
  on thumbv8m.main-none-eabihf mps2-an505 none semihosting
  on thumbv8m.main-none-eabihf pico2 none rtt rtt,knob rtt,pantograph
fi

part 'emulators'
qemu_needs qemu-system-arm qemu-system-arm || true
cargo_needs flip-link || true
if is_all; then
  qemu_needs qemu-system-riscv32 qemu-system-misc || true
  apt_needs node nodejs || true
  apt_needs python3 python3 || true
  apt_needs c++ g++ || true
  apt_needs clang clang libclang-rt-dev || true
  apt_needs cmake cmake make || true
  apt_needs arm-none-eabi-gcc gcc-arm-none-eabi || true
  cargo_needs defmt-print || true
  # The tests that run these programs would build them one after the other.
  cargo build -p stiction-firmware --release --features hosted --bin bits --locked & hosted=$!
  ! target_needs wasm32-unknown-unknown ||
    cargo build -p stiction-firmware --profile device --features hosted --bin bits_wasm --locked --target wasm32-unknown-unknown
  wait $hosted
  # A single cargo builds all images on all cores.
  cargo build -p stiction-firmware --profile device --features board --bin 'count_f*' --bin 'bits_f*' --bin 'footprint*' \
    --locked "${boards[@]}"
  # The images with obstacles are built for small flash: the smallest chip has no more.
  cargo build -p stiction-firmware --profile device-small --features board --bin 'bits_among_*' --locked "${boards[@]}"
fi

part 'tests: compiling'
# The tests run with debug assertions and overflow checks; the nightly run repeats them in a release build. One build of all programs and tests
# shares every dependency; a package built alone would need some of them with other features.
examples=()
! is_all || examples=(--example walk --example walks)
cargo build --locked "${packages[@]}" --lib --bins --tests "${examples[@]}"

part 'tests'
# Nothing runs beside them: the emulated boards must keep time.
! is_all || export STICTION_TESTS=long
cargo_test "${packages[@]}" --lib --bins --tests

! is_all || shown tools $tools

# The page and the Python package leave a core free for the fuzz targets, the oldest compiler, and a walk.
has_fuzz() { command -v c++ && cargo fuzz --version; } >/dev/null 2>&1
oldest=$(sed -n 's/^rust-version = "\(.*\)"/\1/p' Cargo.toml)
others() {
  ! has_fuzz || tests/fuzz/run.sh build
  ! rust_needs "$oldest" ||
    cargo "+$oldest" check -p stiction-core -p stiction-wire -p stiction-host-sim --locked --target-dir "target/rust-$oldest"
  # The program's other systems: what it is built of compiles there.
  for system in x86_64-pc-windows-msvc aarch64-apple-darwin; do
    ! target_needs $system || cargo check -p stiction-host-sim --locked --target $system --target-dir target/systems
  done
  "$built/examples/walk" 10000000
}
if is_all; then
  beside others others
  others=$!
fi

part 'the live page'
if page_needs; then
  npm run --silent --prefix host-sim/tests/web check
  if is_all; then
    # The page without a server and the npm package.
    if target_needs wasm32-unknown-unknown; then
      "$built/stiction-page" --out "$target/page" --npm "$target/npm"
    fi
    node --test --test-concurrency=2 host-sim/tests/web/*.test.js
  else
    # The main behaviours: the first ten seconds, dragging and replaying, frames on the wire.
    node --test --test-concurrency=2 host-sim/tests/web/{first,drag,frame}.test.js
  fi
fi

if is_all; then
  part 'the Python package'
  # The library that the build of the tests has made, with debug assertions and overflow checks; release.sh builds the wheel. Its tests
  # compare it with the program.
  if python_needs; then
    site=$(target/python/bin/python -c 'import sysconfig; print(sysconfig.get_path("platlib"))')
    rm -rf "$site/stiction"
    cp -r host-sim/python/package/stiction "$site/"
    cp "$built/lib_stiction.so" "$site/stiction/_stiction.abi3.so"
    target/python/bin/python -m pytest -q host-sim/python
  fi

  part "the oldest compiler, $oldest, Windows and macOS, and ten million steps of the hand"
  shown others $others
  tail -n 5 $logs/others.log
fi

# fuzz_for_a_minute TARGET INPUTS: the same inputs on every machine, and no more on a fast one, so that a change does not fail by chance. The
# option use_cmp is off because it tries numbers that the program compares, which include addresses.
fuzz_for_a_minute() {
  local log=$logs/fuzz-$1.log
  rm -rf "target/fuzz/found/$1"
  tests/fuzz/run.sh "$1" 60 -seed=4 "-runs=$2" -use_cmp=0 >"$log" 2>&1 || {
    grep -a -m 1 -A 4 'panicked at' "$log" | cut -c 1-500 || true
    tail -n 20 "$log"
    return 1
  }
  printf '%s: %s\n' "$1" "$(grep -a '^Done' "$log")"
}
if is_all; then
  part 'fuzzing, a minute for each target'
  if ! has_fuzz; then
    missing 'cargo-fuzz, or a C++ compiler' 'cargo install cargo-fuzz --locked && apt-get install -y --no-install-recommends g++' || true
  else
    # Two at a time, one for each core.
    (fuzz_for_a_minute wire 600000 && fuzz_for_a_minute scene_file 1300000 && fuzz_for_a_minute hand_path 3000000) & texts=$!
    # Of some three thousand new inputs one finds a known kind of fault (tests/README.md), so a longer search would fail by chance.
    fuzz_for_a_minute solver 3500
    fuzz_for_a_minute obstacles 5000
    wait $texts
  fi
fi

part 'documentation'
RUSTDOCFLAGS='-D warnings' cargo doc "${packages[@]}" --no-deps --locked
cargo_test "${packages[@]}" --doc

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
if is_all; then
  part 'dependencies: licences, sources, duplicates, known vulnerabilities'
  if ! cargo deny --version; then
    missing cargo-deny 'cargo install cargo-deny --locked' || true
  else
    cargo deny --locked check licenses bans sources
    # The database from the network, or, if that cannot be reached, a snapshot of it next to the checkout.
    snapshot=$(printf '%s\n' ../shared/data/advisory-db-*.tar.gz | tail -n 1)
    if cargo deny --locked fetch db; then
      cargo deny --locked --offline check advisories
    elif [ -e "$snapshot" ]; then
      printf 'the database of vulnerabilities cannot be fetched; its snapshot is used: %s\n' "$(basename "$snapshot")"
      as_database "$snapshot"
      cargo deny --locked --offline check advisories
    else
      missing 'the database of vulnerabilities' 'cargo deny fetch db' || true
    fi
  fi
fi
