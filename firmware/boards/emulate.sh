#!/bin/sh
# Runs an image in QEMU 10 or newer (Debian 12: from bookworm-backports), its log decoded by defmt-print
# (cargo install defmt-print).
#   sh emulate.sh MACHINE IMAGE [more options of QEMU]
# MACHINE: the machine of QEMU, which is also the name of the board's folder.
# SERIAL: the other end of the serial line, as for QEMU's -serial; the default is a unix socket.
# ICOUNT: the speed of the emulated clock, as for QEMU's -icount; auto: that of the real one. Without -icount ticks are lost.
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
