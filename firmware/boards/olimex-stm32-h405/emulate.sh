#!/bin/sh
# Runs an image in QEMU 10 or newer (Debian 12: from bookworm-backports), its log decoded by defmt-print
# (cargo install defmt-print).
#   sh emulate.sh IMAGE [more options of QEMU]
# SERIAL: where the serial line goes, as QEMU's -serial says it; else a unix socket.
# ICOUNT: how fast the emulated clock is, as QEMU's -icount says it; auto: with the real one. Without any, ticks are lost.
image=$1
shift
line=${SERIAL:-unix:${TMPDIR:-/tmp}/stiction-olimex-stm32-h405.sock,server=on,wait=off}
echo "serial line: $line"
qemu-system-arm -M olimex-stm32-h405 -display none -monitor none \
  -serial null -serial "$line" -icount "${ICOUNT:-shift=auto}" \
  -semihosting-config enable=on,target=native "$@" -kernel "$image" |
  defmt-print -e "$image"
