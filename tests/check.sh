#!/usr/bin/env bash
# Everything that must hold: format, lints, tests, the live page in a browser, documentation, bare-metal builds, oldest
# compiler, dependencies.
#   tests/check.sh             all of it
#   tests/check.sh --quick     format, lints, and the tests of what changes most often: core, tests, scene files
# Where an optional tool is missing and cannot be installed, the stage is skipped with the command to type;
# with CI=true that is a failure.
set -euo pipefail
cd "$(dirname "$0")/.."

# A checkout that is built once gains nothing from what speeds up the next build or helps to debug, which takes gigabytes and minutes.
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

# missing WHAT COMMAND: skips the stage, or fails where everything must be there.
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
  stage 'the quick checks hold; all of them: tests/check.sh'
  exit
fi

boards=()
for target in thumbv7em-none-eabihf thumbv6m-none-eabi thumbv8m.main-none-eabihf riscv32imc-unknown-none-elf wasm32-unknown-unknown; do
  stage "core and firmware on $target"
  if rustup target list --installed 2>/dev/null | grep -qx "$target" || rustup target add "$target"; then
    cargo build -p stiction-core --profile device --locked --target "$target"
    [ "$target" != wasm32-unknown-unknown ] || continue
    boards+=(--target "$target")
    cargo clippy -p stiction-firmware --features board --locked --target "$target" -- -D warnings
    pico=
    case $target in
      thumbv7em-none-eabihf) board=olimex-stm32-h405 ;;
      thumbv6m-none-eabi) board=microbit pico=pico ;;
      thumbv8m.main-none-eabihf) board=mps2-an505 pico=pico2 ;;
      *) continue ;;
    esac
    for device in ${pico:+none knob pantograph}; do
      cargo clippy -p "stiction-$pico" --features "${device#none}" --locked --target "$target" -- -D warnings
    done
    for log in '' rtt semihosting; do
      # It has no other log than that of its emulator.
      [ "$board-$log" != mps2-an505-rtt ] || continue
      cargo clippy -p "stiction-$board" --no-default-features --features "$log" --locked --target "$target" -- -D warnings
    done
    [ "$board" != olimex-stm32-h405 ] ||
      cargo clippy -p "stiction-$board" --features pantograph --locked --target "$target" -- -D warnings
  else
    missing "target $target" "rustup target add $target"
  fi
done

stage 'emulators and interpreters'
# QEMU knows both boards from version 10 on, which Debian 12 has among its backports: on the mirror that the machine takes its
# packages from.
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
# By one cargo for all, on all cores; the tests that run them would build one after the other.
if [ ${#boards[@]} != 0 ]; then
  cargo build -p stiction-firmware --profile device --features board --bin 'count_*' --bin 'bits_f*' --bin 'footprint*' \
    --locked "${boards[@]}"
  # Among obstacles for little flash: the smallest chip has no more.
  cargo build -p stiction-firmware --profile device-small --features board --bin 'bits_among_*' --locked "${boards[@]}"
fi

# beside LOG COMMAND: runs it next to the stages that follow, with less claim to the cores.
mkdir -p target
beside() {
  local log=target/$1.log
  shift
  (
    renice -n 10 -p "$BASHPID" >/dev/null || true
    "$@"
  ) >"$log" 2>&1 &
}
# shown LOG PROCESS: waits for its end; what it said, if it failed.
shown() {
  wait "$2" || {
    tail -n 60 "target/$1.log"
    return 1
  }
}

# What takes minutes to compile, next to the build of the tests, which does not always need all cores. Not more than that: the emulated
# boards are to keep the time.
installs() {
  local tool
  for tool in deny fuzz; do
    cargo "$tool" --version || env -u CARGO_TARGET_DIR cargo install "cargo-$tool" --locked
  done
}
beside cargo-tools installs
installs=$!

stage 'tests'
# With debug assertions and overflow checks. That a release build computes the same is among them, by the bits of all answers; the tests
# in one are a matter of the nightly run. What no test runs is not built: the examples, which the lints have looked at.
cargo test --no-fail-fast --workspace --exclude stiction-bench --locked --lib --bins --tests
cargo test --no-fail-fast --workspace --exclude stiction-bench --locked --doc

# The page and the Python package leave a core free: for the fuzz targets, the oldest compiler, and a walk.
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
  cargo run --release --locked -p stiction-tests --example walk -- 10000000
}
beside others others
others=$!

stage 'the live page'
# In Node.js 20 or newer and in Chromium; the page's tools and playwright come from a lock file.
has_node() { command -v npm && [ "$(node -p 'process.versions.node.split(".")[0]')" -ge 20 ]; } >/dev/null 2>&1
has_browser() {
  [ -n "${CHROMIUM:-}" ] || command -v chromium || command -v chromium-browser || command -v google-chrome
}
# Where the distribution's Node.js is older, npm has a newer one.
node='apt-get install -y --no-install-recommends nodejs npm && npm install --global node@22'
browser='apt-get install -y --no-install-recommends chromium fonts-dejavu-core'
has_node || { apt-get update && eval "$node" && hash -r; } || true
has_browser || { apt-get update && $browser; } || true
if ! has_node; then
  missing 'Node.js 20 or newer with npm' "$node"
elif ! has_browser; then
  missing 'Chromium' "$browser"
elif ! npm ci --prefix host-sim/tests/web --no-audit --no-fund; then
  missing 'the packages of the tests of the page' 'npm ci --prefix host-sim/tests/web'
else
  npm run --prefix host-sim/tests/web check
  # The page without a server and the npm package, which the tests below look at.
  if rustup target add wasm32-unknown-unknown; then
    cargo run --release --locked -p stiction-page -- --out "${CARGO_TARGET_DIR:-target}/page" --npm "${CARGO_TARGET_DIR:-target}/npm"
    cargo build --release --locked -p stiction-live --features obstacles --example bits
  else
    missing 'the target wasm32-unknown-unknown' 'rustup target add wasm32-unknown-unknown'
  fi
  node --test --test-concurrency=1 host-sim/tests/web/*.test.js
fi

stage 'the Python package'
# With debug assertions and overflow checks, of what the tests above have built, in an environment of its own; its tests compare it with
# the program.
venv='apt-get install -y --no-install-recommends python3-venv'
python3 -c 'import ensurepip' 2>/dev/null || { apt-get update && $venv; } || true
if ! python3 -c 'import ensurepip' 2>/dev/null; then
  missing 'venv of Python' "$venv"
elif ! { python3 -m venv target/python && target/python/bin/pip install -q -r host-sim/python/tests/requirements.txt; }; then
  missing 'the packages of the tests of the Python package' 'target/python/bin/pip install -r host-sim/python/tests/requirements.txt'
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
# The same inputs on every machine, and not more where it is fast: a change is not to fail by chance. Without use_cmp, which tries
# numbers that the program compares, addresses among them. The nightly run looks elsewhere each time. The runtime of libFuzzer is
# C++.
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

# as_database ARCHIVE: cargo-deny fetches its database from the files of this archive.
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
  # The database of the network; where that cannot be reached, a snapshot of it that lies beside the checkout.
  snapshot=$(printf '%s\n' ../shared/data/advisory-db-*.tar.gz | tail -n 1)
  if cargo deny --locked fetch db; then
    cargo deny --locked --offline check advisories
  elif [ -e "$snapshot" ]; then
    printf 'the database of vulnerabilities cannot be fetched from here; its snapshot: %s\n' "$(basename "$snapshot")"
    as_database "$snapshot"
    cargo deny --locked --offline check advisories
  else
    missing 'the database of vulnerabilities' 'cargo deny fetch db'
  fi
else
  tail -n 20 target/cargo-tools.log
  missing cargo-deny 'cargo install cargo-deny --locked'
fi

stage 'all checks hold'
