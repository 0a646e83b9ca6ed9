/* A computer. */
#include "machine.h"

#include <stdio.h>

void say(const char *text, uint32_t number)
{
    printf("%s %08lx\n", text, (unsigned long)number);
}

void count_from_here(void) {}

uint32_t counted(void)
{
    return 0;
}
