#!/usr/bin/env bash
# Builds the archives of every chip, with the headers and the files that CMake's find_package needs:
# OUT/include, OUT/lib/cmake, OUT/lib/<target>/libstiction{,_fixed}{,_obstacles,_plane}.a
#   firmware/c/archives.sh OUT [TARGET ...]
# TARGET: its name for rustc; the default is all targets below. STICTION_VARIANTS: only these of the six variants.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
[ $# -gt 0 ] || {
  sed -n '2,4s/^# *//p' "$0" >&2
  exit 2
}
mkdir -p "$1"
out=$(cd "$1" && pwd)
shift
# Cortex-M0 and M0+; M3, and M4 and M33 without floating-point unit; M4F and M7F (F4, G4, H7, nRF52840, Teensy 4) and M33 (RP2350, nRF5340),
# for -mfloat-abi=softfp and =hard each; ESP32-C3; a computer.
[ $# -gt 0 ] || set -- thumbv6m-none-eabi thumbv7m-none-eabi thumbv7em-none-eabi thumbv7em-none-eabihf thumbv8m.main-none-eabi \
  thumbv8m.main-none-eabihf riscv32imc-unknown-none-elf x86_64-unknown-linux-gnu
# For few instructions, but the small variant for little flash; STICTION_PROFILE: `device` or `device-small` for all.
profile_of() {
  case $1 in
    *plane) printf device-small ;;
    *) printf device ;;
  esac
}
target_dir=${CARGO_TARGET_DIR:-$here/../../target}

IFS=' ' read -r -a variants <<<"${STICTION_VARIANTS:-float fixed obstacles fixed,obstacles plane fixed,plane}"

mkdir -p "$out/include" "$out/lib/cmake/stiction"
cp "$here"/include/stiction.h* "$out/include/"
cp "$here"/packages/cmake/* "$out/lib/cmake/stiction/"
# flags_of TARGET VARIANT: the flags that .cargo/config.toml does not have. It cannot name a target with a dot. For a processor that inlines up
# to 200, the small variant inlines less: at 50, the knob takes 10 % less flash and 20 % more instructions than at 200. Functions for softfp pass numbers in integer
# registers, and compute with the floating-point unit that the processor brings; an M7F executes the code of an M4F.
flags_of() {
  local inline='' cpu=''
  case $1,$2 in
    thumbv7em*,*plane | thumbv8m*,*plane) inline=50 ;;
    thumbv8m.main-none-eabi*,* | thumbv7em-none-eabi,*) inline=200 ;;
  esac
  case $1 in
    thumbv7em-none-eabi) cpu=cortex-m4 ;;
    thumbv8m.main-none-eabi) cpu=cortex-m33 ;;
  esac
  printf '%s' "${inline:+-C llvm-args=-inline-threshold=$inline}${cpu:+ -C target-cpu=$cpu}"
}
for target in "$@"; do
  rustup target list --installed 2>/dev/null | grep -qx "$target" || rustup target add "$target"
  mkdir -p "$out/lib/$target"
  for variant in "${variants[@]}"; do
    features=archive name=libstiction
    [ "$variant" = float ] || features=archive,$variant name=libstiction_${variant/,/_}
    profile=${STICTION_PROFILE:-$(profile_of "$variant")}
    flags=$(flags_of "$target" "$variant")
    (
      cd "$here"
      [ -z "$flags" ] || export RUSTFLAGS="${CARGO_BUILD_RUSTFLAGS:-} $flags"
      cargo rustc --lib --crate-type staticlib --profile "$profile" --locked --features "$features" --target "$target"
    )
    # In one step: a linker may be reading the earlier one.
    cp "$target_dir/$target/$profile/libstiction.a" "$out/lib/$target/$name.new"
    mv "$out/lib/$target/$name.new" "$out/lib/$target/$name.a"
  done
done
