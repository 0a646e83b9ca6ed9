#!/bin/sh
# Runs an image in QEMU 10 or newer. Its serial line is where SERIAL says (default: the terminal's own pseudo-terminal, which
# QEMU names), its log is decoded by defmt-print (cargo install defmt-print).
#   sh emulate.sh IMAGE [more options of QEMU]
image=$1
shift
exec 3>&1
qemu-system-arm -M olimex-stm32-h405 -display none -monitor none \
  -serial null -serial "${SERIAL:-pty}" \
  -semihosting-config enable=on,target=native "$@" -kernel "$image" |
  defmt-print -e "$image"
