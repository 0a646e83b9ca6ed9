#!/usr/bin/env bash
# Builds what is given away.
#   host-sim/release.sh                      the program alone, without symbols and without a path of whoever builds it:
#                                            target/shipped/release/stiction
#   host-sim/release.sh --all DIR [PART ..]  all that a release holds, in DIR, with SHA256SUMS; or these parts of it:
#     program   the program for this system, with both licences
#     wheel     the Python package for this system
#     npm       the npm package, and the page in one file
#     c         the C library: archives of all chips, packages for CMake, Arduino, ESP-IDF and Zephyr
#     images    the images of the boards: UF2 for their drives, ELF for a probe
# Where a tool is missing, its part is left out, with the command to type, and the exit status is 1.
# The paths in messages of panics begin at the folder of a crate. Fails where a path is left in the program, the library of the wheel, the
# wasm, the page or an image for a drive. An ELF for a probe keeps its symbols, and the archives for C are not looked through.
set -euo pipefail
cd "$(dirname "$0")/.."

here=$PWD
crates=${CARGO_HOME:-$HOME/.cargo}
compiler=$(rustc --print sysroot)
target=${CARGO_TARGET_DIR:-$here/target}
shipped=$target/shipped
version=$(sed -n 's/^version = "\(.*\)"/\1/p' Cargo.toml | head -n 1)
system=$(rustc -vV | sed -n 's/^host: //p')
exe=
case $system in *-windows-*) exe=.exe ;; esac
program=$shipped/release/stiction$exe

# The compiler takes the last prefix that fits. A profile has no such setting in stable Rust (`trim-paths`), and .cargo/config.toml
# knows neither the folder of the user nor this one.
flags=() quoted=
for prefix in "$HOME=home" "$here=" "$target=built" "$shipped=built" "$crates=crates" "$crates/registry/src=crates" \
  "$compiler/lib/rustlib/src/rust=rust"; do
  flags+=("--remap-path-prefix=$prefix")
  quoted+="${quoted:+,}\"--remap-path-prefix=$prefix\""
done
unset RUSTFLAGS CARGO_ENCODED_RUSTFLAGS

# without_paths FILE: fails where it holds a path of this machine.
without_paths() {
  local path left
  for path in "$HOME/" "$here" "$shipped" "$crates" "$compiler"; do
    if left=$(grep -aoF -m 1 -- "$path" "$1"); then
      printf '%s holds the path %s\n' "$1" "${left%%$'\n'*}" >&2
      return 1
    fi
  done
}

build_program() {
  cargo build --release --locked -p stiction-host-sim --target-dir "$shipped" --config "build.rustflags=[$quoted]"
  without_paths "$program"
  # The linker's package has nm.
  if command -v nm >/dev/null && [ -n "$(nm "$program" 2>/dev/null)" ]; then
    printf '%s has symbols\n' "$program"
    return 1
  fi
  printf '%s: %s bytes, no symbols, no path of this machine\n' "$program" "$(wc -c <"$program")"
}

if [ $# = 0 ]; then
  build_program
  exit
fi
[ "$1" = --all ] && [ $# -ge 2 ] || {
  sed -n '2,/^set/s/^# *//p' "$0" >&2
  exit 2
}
into=$2
shift 2
[ $# -gt 0 ] || set -- program wheel npm c images
for part in "$@"; do
  case $part in
    program | wheel | npm | c | images) ;;
    *)
      printf 'unknown part: %s; allowed: program, wheel, npm, c, images\n' "$part" >&2
      exit 2
      ;;
  esac
done
mkdir -p "$into"
out=$(cd "$into" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
left_out=0

# missing WHAT COMMAND
missing() {
  printf 'left out, as there is no %s; to install it: %s\n' "$1" "$2" >&2
  left_out=1
}
# has_targets TARGET ..: whether they are there, after they were added where they may be.
has_targets() {
  local chip
  for chip in "$@"; do
    rustup target list --installed 2>/dev/null | grep -qx "$chip" || rustup target add "$chip" || {
      missing "target $chip" "rustup target add $chip"
      return 1
    }
  done
}
chips=(thumbv6m-none-eabi thumbv7em-none-eabihf thumbv8m.main-none-eabihf)
# packed NAME: the folder of that name in $work, as an archive. Every archive has the licences.
packed() {
  cp LICENSE-MIT LICENSE-APACHE "$work/$1/"
  tar -C "$work" --sort=name --owner=0 --group=0 --numeric-owner -czf "$out/$1.tar.gz" "$1"
}

part_program() {
  build_program
  local name=stiction-$version-$system
  mkdir "$work/$name"
  cp "$program" "$work/$name/"
  packed "$name"
}

part_wheel() {
  local maturin
  maturin=$(command -v maturin) || {
    missing maturin 'pip install maturin'
    return
  }
  CARGO_TARGET_DIR=$shipped "$maturin" build --release --locked -m host-sim/python/Cargo.toml --out "$work/wheels" \
    --config "build.rustflags=[$quoted]"
  for wheel in "$work"/wheels/*.whl; do
    python3 -m zipfile -e "$wheel" "$work/wheel"
    for library in "$work"/wheel/stiction/_stiction*; do without_paths "$library"; done
    cp "$wheel" "$out/"
  done
}

part_npm() {
  command -v npm >/dev/null || {
    missing npm 'apt-get install -y --no-install-recommends npm'
    return
  }
  has_targets wasm32-unknown-unknown || return 0
  CARGO_TARGET_DIR=$shipped CARGO_BUILD_RUSTFLAGS="${flags[*]}" \
    cargo run --release --locked -p stiction-page -- --out "$work/page" --npm "$work/npm"
  for file in "$work"/npm/*.wasm "$work/page/stiction.html"; do without_paths "$file"; done
  npm pack "$work/npm" --pack-destination "$out" >/dev/null
  cp "$work/page/stiction.html" "$out/stiction-$version.html"
}

part_c() {
  local name=stiction-c-$version
  has_targets "${chips[@]}" thumbv7m-none-eabi thumbv7em-none-eabi thumbv8m.main-none-eabi riscv32imc-unknown-none-elf || return 0
  CARGO_TARGET_DIR=$shipped CARGO_BUILD_RUSTFLAGS="${flags[*]}" firmware/c/packages.sh "$work/$name"
  cp firmware/c/README.md firmware/c/CHANGELOG.md "$work/$name/"
  packed "$name"
}

part_images() {
  command -v flip-link >/dev/null || {
    missing flip-link 'cargo install flip-link --locked'
    return
  }
  has_targets "${chips[@]}" || return 0
  [ -x "$program" ] || build_program
  local image board device end file
  for image in pico.uf2 pico:knob.uf2 pico:pantograph.uf2 pico2.uf2 pico2:knob.uf2 pico2:pantograph.uf2 microbit.elf olimex-stm32-h405.elf; do
    end=${image##*.} board=${image%.*}
    device=${board#*:} board=${board%%:*}
    [ "$device" != "$board" ] || device=
    file=$out/stiction-$version-$board${device:+-$device}.$end
    "$program" image "$board" ${device:+--device "$device"} --out "$file"
    [ "$end" != uf2 ] || without_paths "$file"
  done
}

for part in "$@"; do "part_$part"; done

cd "$out"
rm -f SHA256SUMS
sha256sum -- * >"$work/SHA256SUMS"
mv "$work/SHA256SUMS" .
printf '\n%s:\n' "$out"
ls -l
exit "$left_out"
