/* Turns the knob by half a turn: it clicks, and between two clicks its torque grows with the angle. */
#include "stiction.h"

int knob_begin(void);
float knob_tick(float angle, stiction_output *output);

int main(void)
{
    float before = 0.0f;
    int clicks = 0, i;
    if (knob_begin() != 0)
        return 1;
    for (i = 1; i <= 3142; i++) {
        const float torque = knob_tick(0.001f * (float)i, NULL);
        if (torque > before)
            clicks++;
        before = torque;
    }
    return clicks < 10 || clicks > 16;
}
