/*
 * A knob with detents: a point tool that is pressed against a floor and turned along it. It sticks, and slips from click to click; each
 * click is (mu_s - mu_d) * DEPTH / RADIUS = 0.2 rad long.
 */
#include "stiction.h"

#define RADIUS 0.010f /* m: turns of the knob are displacements along the floor */
#define DEPTH 0.005f  /* m: how far the hand is pressed below the floor */
/* Units of work of a tick; at 1 kHz a Cortex-M0+ at 125 MHz has time for 34. The next two ticks do the rest of a click. */
#define BUDGET 32

static stiction solver;

/* Returns 0, or the error. */
int knob_begin(void)
{
    static const float tool[1][2] = {{0.0f, 0.0f}};
    static const stiction_surface floor = {
        .normal = {0.0f, 1.0f}, .friction_static = 0.9f, .friction_dynamic = 0.5f};
    const stiction_scene scene = {
        .vertices = tool,
        .vertex_count = 1,
        .has_holding_point = 1,
        .stiffness_translation = 200.0f,
        .stiffness_rotation = 0.01f,
        .surfaces = &floor,
        .surface_count = 1,
    };
    const stiction_hand hand = {.y = -DEPTH, .held = 1};
    int result = stiction_init(&solver, sizeof solver, STICTION_ABI, &scene, NULL);
    if (result == STICTION_RESULT_OK)
        result = stiction_set_budget(&solver, BUDGET);
    return result != STICTION_RESULT_OK ? result : stiction_start(&solver, &hand, NULL);
}

/* A tick of the control loop: from the angle of the knob (rad) to the torque of its motor (N m). output: may be null. */
float knob_tick(float angle, stiction_output *output)
{
    const stiction_hand hand = {.x = RADIUS * angle, .y = -DEPTH, .held = 1};
    stiction_wrench_on_body wrench;
    if (stiction_step(&solver, &hand, output) != STICTION_RESULT_OK ||
        stiction_wrench(&solver, &wrench) != STICTION_RESULT_OK)
        return 0.0f;
    return -RADIUS * wrench.fx;
}
