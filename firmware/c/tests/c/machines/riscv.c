/* An emulated RISC-V, from reset to the end. */
#include "semihosting.h"

int main(void);

static void call(int operation, const void *argument)
{
    register int a0 __asm__("a0") = operation;
    register const void *a1 __asm__("a1") = argument;
    __asm__ volatile(".balign 16\n .option push\n .option norvc\n"
                     "slli x0, x0, 0x1f\n ebreak\n srai x0, x0, 7\n .option pop"
                     : "+r"(a0)
                     : "r"(a1)
                     : "memory");
}

static uint32_t begun;

static uint32_t instructions(void)
{
    uint32_t now;
    __asm__ volatile("csrr %0, minstret" : "=r"(now));
    return now;
}

void count_from_here(void)
{
    begun = instructions();
}

uint32_t counted(void)
{
    return instructions() - begun;
}

__attribute__((used)) static void begin(void)
{
    end(main());
    for (;;) {
    }
}

__asm__(".section .vectors, \"ax\"\n"
        ".global reset\n"
        "reset: la sp, stack_top\n"
        "la t0, zero_begin\n"
        "la t1, zero_end\n"
        "1: bgeu t0, t1, 2f\n"
        "sw zero, 0(t0)\n"
        "addi t0, t0, 4\n"
        "j 1b\n"
        "2: j begin\n"
        ".text\n");
