/* The functions that a test needs of the machine that it runs on. */
#ifndef MACHINE_H
#define MACHINE_H

#include <stdint.h>

/* Prints a text and a number in hexadecimal, in a line. */
void say(const char *text, uint32_t number);

/* Instructions since `count_from_here`, where the machine counts them; 0 elsewhere. */
void count_from_here(void);
uint32_t counted(void);

#endif
