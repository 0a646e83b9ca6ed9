#!/bin/sh
# Runs an image in QEMU 10 or newer (Debian 12: from bookworm-backports), its log decoded by defmt-print
# (cargo install defmt-print).
#   sh emulate.sh MACHINE IMAGE [more options of QEMU]
# MACHINE: that of QEMU, by the name of the board's folder.
# SERIAL: where the serial line goes, as QEMU's -serial says it; else a unix socket.
# ICOUNT: how fast the emulated clock is, as QEMU's -icount says it; auto: with the real one. Without any, ticks are lost.
machine=$1
image=$2
shift 2
line=${SERIAL:-unix:${TMPDIR:-/tmp}/stiction-$machine.sock,server=on,wait=off}
# Serial lines of the machine before the one of the image.
unused=
[ "$machine" != olimex-stm32-h405 ] || unused='-serial null'
echo "serial line: $line"
# shellcheck disable=SC2086
qemu-system-arm -M "$machine" -display none -monitor none \
  $unused -serial "$line" -icount "${ICOUNT:-shift=auto}" \
  -semihosting-config enable=on,target=native "$@" -kernel "$image" |
  defmt-print -e "$image"
