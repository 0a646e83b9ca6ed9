/*
 * Ten scenes with a random walk of the hand; prints a hash of all answers for each. Nothing in the walk is rounded: positions are whole
 * multiples of 2^-20 m and angles of 2^-20 rad.
 */
#include "machine.h"
#include "stiction.h"

#include "scenes.h"

static uint32_t seed, hash;

static uint32_t random_bits(void)
{
    seed ^= seed << 13;
    seed ^= seed >> 17;
    seed ^= seed << 5;
    return seed;
}

/* From a position, at most `most` farther, within `limit` of 0. */
static int32_t walked(int32_t place, int32_t most, int32_t limit)
{
    const int32_t to = place + (int32_t)(random_bits() % (2u * (uint32_t)most + 1u)) - most;
    return to > limit || to < -limit ? place : to;
}

/* FNV-1a, a word at a time. */
static void take(uint32_t word)
{
    hash = (hash ^ word) * 16777619u;
}

static void take_float(float number)
{
    union {
        float number;
        uint32_t word;
    } both;
    both.number = number;
    take(both.word);
}

static int take_answer(const stiction *solver, const stiction_output *output)
{
    stiction_wrench_on_body wrench;
    stiction_contact contacts[STICTION_CONTACTS];
    uint32_t count, i;
    int result = stiction_wrench(solver, &wrench);
    if (result == STICTION_RESULT_OK)
        result = stiction_contacts(solver, contacts, &count);
    if (result != STICTION_RESULT_OK)
        return result;
    take_float(output->x);
    take_float(output->y);
    take_float(output->theta);
    take((uint32_t)output->turns);
    take(output->slips);
    take((uint32_t)output->state | (uint32_t)output->status << 8 | (uint32_t)output->event_count << 16);
    take_float(wrench.fx);
    take_float(wrench.fy);
    take_float(wrench.moment);
    for (i = 0; i < count; i++) {
        take_float(contacts[i].x);
        take_float(contacts[i].normal);
        take_float(contacts[i].friction);
        take((uint32_t)contacts[i].feature | (uint32_t)contacts[i].other << 8 | (uint32_t)(uint8_t)contacts[i].sliding << 16);
    }
    return result;
}

static int walk(const stiction_scene *scene, uint8_t evolution)
{
    static stiction solver;
    int32_t x = 0, y = 0, phi = 0;
    uint32_t frame;
    int result = stiction_init(&solver, sizeof solver, STICTION_ABI, scene, NULL);
    if (result == STICTION_RESULT_OK)
        result = stiction_set_evolution(&solver, evolution);
    for (frame = 0; frame < FRAMES && result == STICTION_RESULT_OK; frame++) {
        const float unit = 1.0f / (1 << 20);
        stiction_output output;
        stiction_hand hand = {.held = 1};
        hand.x = scene->start[0] + unit * (float)x;
        hand.y = scene->start[1] + unit * (float)y;
        hand.phi = scene->start[2] + unit * (float)phi;
        result = frame == 0 ? stiction_start(&solver, &hand, &output) : stiction_step(&solver, &hand, &output);
        if (result == STICTION_RESULT_OK)
            result = take_answer(&solver, &output);
        x = walked(x, 1 << 11, 1 << 17);
        y = walked(y, 1 << 11, 1 << 16);
        phi = walked(phi, 1 << 14, 1 << 20);
    }
    return result;
}

int main(void)
{
    uint32_t i;
    for (i = 0; i < SCENES; i++) {
        int result;
        seed = 2463534242u + i;
        hash = 2166136261u;
        result = walk(scenes[i], (uint8_t)(i % 2));
        if (result != STICTION_RESULT_OK) {
            say("result", (uint32_t)result);
            return 1;
        }
        say("hash", hash);
    }
    return 0;
}
