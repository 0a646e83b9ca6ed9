// stiction, in the number type of the archive for this board: single precision with a floating-point unit, fixed point without.
#ifndef STICTION_ARDUINO_H
#define STICTION_ARDUINO_H

#if !defined(__ARM_FP) && !defined(__x86_64__)
#define STICTION_FIXED
#endif

#include "stiction.hpp"

#endif
