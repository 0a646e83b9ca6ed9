/* An emulated Cortex-M, from reset to the end. */
#include "semihosting.h"

extern uint32_t data_begin[], data_end[], data_kept[], zero_begin[], zero_end[], stack_top[];

int main(void);

static void call(int operation, const void *argument)
{
    register int r0 __asm__("r0") = operation;
    register const void *r1 __asm__("r1") = argument;
    __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
}

/* SysTick, which QEMU derives from the instructions with -icount shift=SHIFT: each takes 2^SHIFT ns. */
#define SYST_CSR (*(volatile uint32_t *)0xE000E010)
#define SYST_RVR (*(volatile uint32_t *)0xE000E014)
#define SYST_CVR (*(volatile uint32_t *)0xE000E018)

void count_from_here(void)
{
    SYST_RVR = 0xFFFFFF;
    SYST_CVR = 0;
    SYST_CSR = 5;
}

uint32_t counted(void)
{
    const uint64_t ticks = 0xFFFFFF - SYST_CVR;
    return (uint32_t)((ticks * 1000000000u / CLOCK) >> SHIFT);
}

static void reset(void)
{
    uint32_t *to = data_begin;
    const uint32_t *from = data_kept;
#ifdef __ARM_FP
    /* The floating-point unit is off after a reset. */
    *(volatile uint32_t *)0xE000ED88 |= 0xFu << 20;
    __asm__ volatile("dsb\n isb" ::: "memory");
#endif
    while (to < data_end)
        *to++ = *from++;
    for (to = zero_begin; to < zero_end; to++)
        *to = 0;
    end(main());
    for (;;) {
    }
}

static void fault(void)
{
    end(1);
    for (;;) {
    }
}

/* The entry points: reset, and two faults. */
__attribute__((section(".vectors"), used)) static const struct {
    void *stack;
    void (*handlers[3])(void);
} vectors = {stack_top, {reset, fault, fault}};
