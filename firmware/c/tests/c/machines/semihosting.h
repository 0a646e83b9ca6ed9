/* Calls to the host of the emulator, without a C library: printing, and the exit. */
#ifndef SEMIHOSTING_H
#define SEMIHOSTING_H

#include "machine.h"

enum { WRITE = 4, EXIT = 24, EXITED = 0x20026, FAILED = 0x20023 };

/* With the instruction of the processor. */
static void call(int operation, const void *argument);

void say(const char *text, uint32_t number)
{
    char digits[11];
    int i;
    digits[0] = ' ';
    for (i = 0; i < 8; i++)
        digits[1 + i] = "0123456789abcdef"[number >> (28 - 4 * i) & 15];
    digits[9] = '\n';
    digits[10] = '\0';
    call(WRITE, text);
    call(WRITE, digits);
}

static void end(int result)
{
    call(EXIT, (const void *)(uintptr_t)(result == 0 ? EXITED : FAILED));
}

#endif
