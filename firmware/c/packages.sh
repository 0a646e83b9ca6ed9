#!/usr/bin/env bash
# Builds the archives and packs them for the tools of C programmers, each package with headers and examples:
#   firmware/c/packages.sh OUT
# OUT/stiction (headers, archives, CMake), OUT/arduino/Stiction, OUT/esp-idf/stiction, OUT/zephyr/stiction
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
[ $# -eq 1 ] || {
  sed -n '2,4s/^# *//p' "$0" >&2
  exit 2
}
"$here/archives.sh" "$1/stiction"

cd "$1"
rm -rf arduino/Stiction esp-idf/stiction zephyr/stiction
mkdir -p arduino esp-idf zephyr
cp -r "$here/packages/arduino" arduino/Stiction
cp stiction/include/* arduino/Stiction/src/
cp "$here/examples/knob.c" arduino/Stiction/examples/Knob/
cp "$here"/examples/pantograph.* arduino/Stiction/examples/Pantograph/
# for_mcu MCU TARGET NAME: the folder that Arduino searches, from the board's build.mcu and its compiler's flags for the floating-point unit.
for_mcu() {
  mkdir -p "arduino/Stiction/src/$1"
  cp "stiction/lib/$2/$3.a" "arduino/Stiction/src/$1/libstiction.a"
}
for_mcu cortex-m0plus thumbv6m-none-eabi libstiction_fixed
for_mcu cortex-m3 thumbv7m-none-eabi libstiction_fixed
for_mcu cortex-m4/fpv4-sp-d16-hard thumbv7em-none-eabihf libstiction
for_mcu cortex-m4/fpv4-sp-d16-softfp thumbv7em-none-eabi libstiction
for_mcu cortex-m7/fpv5-d16-hard thumbv7em-none-eabihf libstiction
for_mcu cortex-m33/fpv5-sp-d16-hard thumbv8m.main-none-eabihf libstiction
# The RP2350: its core names a floating-point unit by -march, without -mfpu.
for_mcu cortex-m33/softfp thumbv8m.main-none-eabi libstiction
for_mcu cortex-m33/fpv5-sp-d16-softfp thumbv8m.main-none-eabi libstiction
for_mcu esp32c3 riscv32imc-unknown-none-elf libstiction_fixed

cp -r "$here/packages/esp-idf" esp-idf/stiction
cp -r "$here/packages/zephyr" zephyr/stiction
for package in esp-idf zephyr; do
  cp -r stiction/include stiction/lib "$package/stiction/"
  rm -rf "$package/stiction/lib/cmake" "$package/stiction/lib/x86_64-unknown-linux-gnu"
done
