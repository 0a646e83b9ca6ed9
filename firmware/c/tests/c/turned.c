/* Turns the knob of the examples back and forth ten times; prints how often it clicked, and the instructions and units of work of its
 * worst tick; fails if it is behind the hand for more than two ticks. */
#include "machine.h"
#include "stiction.h"

int knob_begin(void);
float knob_tick(float angle, stiction_output *output);

/* Ticks of a turn. */
#define TURN 1000

int main(void)
{
    uint32_t worst = 0, work = 0, clicks = 0;
    float before = 0.0f;
    int way, i, place = 0, behind = 0;
    if (knob_begin() != 0)
        return 1;
    for (way = 0; way < 20; way++) {
        const int step = way % 2 == 0 ? 1 : -1;
        for (i = 0; i < TURN; i++) {
            stiction_output output;
            float torque;
            uint32_t taken;
            place += step;
            count_from_here();
            torque = knob_tick(6.2831853f / TURN * (float)place, &output);
            taken = counted();
            if (taken > worst)
                worst = taken;
            if (output.work > work)
                work = output.work;
            behind = output.status == STICTION_STATUS_BEHIND ? behind + 1 : 0;
            if (behind > 2 || output.status > STICTION_STATUS_BEHIND)
                return 1;
            /* The torque opposes the turn, and is smaller after a click. */
            if (i > 0 && (float)step * (torque - before) > 0.0f)
                clicks++;
            before = torque;
        }
    }
    say("worst", worst);
    say("work", work);
    say("clicks", clicks);
    return 0;
}
