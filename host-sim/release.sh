#!/usr/bin/env bash
# Builds the program to be given away: target/shipped/release/stiction, without symbols and without a path of whoever builds it. The
# paths in messages of panics then begin at the folder of a crate. Fails where a path is left.
set -euo pipefail
cd "$(dirname "$0")/.."

here=$PWD
crates=${CARGO_HOME:-$HOME/.cargo}
compiler=$(rustc --print sysroot)
shipped=${CARGO_TARGET_DIR:-$here/target}/shipped

# The compiler takes the last prefix that fits. A profile has no such setting in stable Rust (`trim-paths`), and .cargo/config.toml
# knows neither the folder of the user nor this one.
flags=
for prefix in "$HOME=home" "$here=" "$shipped=built" "$crates=crates" "$crates/registry/src=crates" "$compiler/lib/rustlib/src/rust=rust"; do
  flags+="${flags:+,}\"--remap-path-prefix=$prefix\""
done
env -u RUSTFLAGS -u CARGO_ENCODED_RUSTFLAGS \
  cargo build --release --locked -p stiction-host-sim --target-dir "$shipped" --config "build.rustflags=[$flags]"

program=$shipped/release/stiction
for path in "$HOME/" "$here" "$shipped" "$crates" "$compiler"; do
  if left=$(grep -aoF -m 1 -- "$path" "$program"); then
    printf '%s holds the path %s\n' "$program" "${left%%$'\n'*}"
    exit 1
  fi
done
# The linker's package has nm.
if command -v nm >/dev/null && [ -n "$(nm "$program" 2>/dev/null)" ]; then
  printf '%s has symbols\n' "$program"
  exit 1
fi
printf '%s: %s bytes, no symbols, no path of this machine\n' "$program" "$(wc -c <"$program")"
