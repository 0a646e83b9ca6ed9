#!/usr/bin/env bash
# Builds the archives of every chip, with the headers and the files that CMake's find_package needs:
# OUT/include, OUT/lib/cmake, OUT/lib/<target>/libstiction{,_fixed,_obstacles,_fixed_obstacles}.a
#   firmware/c/archives.sh OUT [TARGET ...]
# TARGET: its name for rustc; the default is all targets below. STICTION_VARIANTS: only these of the four variants.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
[ $# -gt 0 ] || {
  sed -n '2,4s/^# *//p' "$0" >&2
  exit 2
}
mkdir -p "$1"
out=$(cd "$1" && pwd)
shift
# Cortex-M0 and M0+; M4F and M7F (F4, G4, H7, nRF52840, Teensy 4); M33 (RP2350, nRF5340); ESP32-C3; a computer.
[ $# -gt 0 ] || set -- thumbv6m-none-eabi thumbv7em-none-eabihf thumbv8m.main-none-eabihf riscv32imc-unknown-none-elf x86_64-unknown-linux-gnu
# For few instructions; `STICTION_PROFILE=device-small` for little flash.
profile=${STICTION_PROFILE:-device}
target_dir=${CARGO_TARGET_DIR:-$here/../../target}

IFS=' ' read -r -a variants <<<"${STICTION_VARIANTS:-float fixed obstacles fixed,obstacles}"

mkdir -p "$out/include" "$out/lib/cmake/stiction"
cp "$here"/include/stiction.h* "$out/include/"
cp "$here"/packages/cmake/* "$out/lib/cmake/stiction/"
for target in "$@"; do
  rustup target list --installed 2>/dev/null | grep -qx "$target" || rustup target add "$target"
  mkdir -p "$out/lib/$target"
  for variant in "${variants[@]}"; do
    features=archive name=libstiction
    [ "$variant" = float ] || features=archive,$variant name=libstiction_${variant/,/_}
    (cd "$here" && cargo rustc --lib --crate-type staticlib --profile "$profile" --locked --features "$features" --target "$target")
    cp "$target_dir/$target/$profile/libstiction.a" "$out/lib/$target/$name.a"
  done
done
