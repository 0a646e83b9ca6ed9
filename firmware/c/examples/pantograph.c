/* A pantograph that holds a box between a floor and a wall. */
#include "pantograph.h"

#include <math.h>

#include "stiction.h"

/* Below this sine of the angle between the distal links a force across them cannot be controlled. */
#define LEAST_SINE 0.2f

static stiction solver;

/* The ends of the proximal links. */
static void elbows(const float angles[2], float at[2][2])
{
    int i;
    for (i = 0; i < 2; i++) {
        at[i][0] = (i == 0 ? -PANTOGRAPH_HALF_BASE : PANTOGRAPH_HALF_BASE) + PANTOGRAPH_PROXIMAL * cosf(angles[i]);
        at[i][1] = PANTOGRAPH_PROXIMAL * sinf(angles[i]);
    }
}

int pantograph_handle(const float angles[2], float handle[2])
{
    float at[2][2], across[2], half, height;
    elbows(angles, at);
    across[0] = at[1][0] - at[0][0];
    across[1] = at[1][1] - at[0][1];
    half = 0.5f * sqrtf(across[0] * across[0] + across[1] * across[1]);
    if (!(half > 0.0f && half < PANTOGRAPH_DISTAL))
        return 0;
    height = sqrtf(PANTOGRAPH_DISTAL * PANTOGRAPH_DISTAL - half * half) / (2.0f * half);
    handle[0] = 0.5f * (at[0][0] + at[1][0]) - height * across[1];
    handle[1] = 0.5f * (at[0][1] + at[1][1]) + height * across[0];
    return 1;
}

void pantograph_torques(const float angles[2], const float force[2], float torques[2])
{
    float at[2][2], handle[2], link[2][2], sine;
    int i;
    torques[0] = torques[1] = 0.0f;
    if (!pantograph_handle(angles, handle))
        return;
    elbows(angles, at);
    for (i = 0; i < 2; i++) {
        link[i][0] = (handle[0] - at[i][0]) / PANTOGRAPH_DISTAL;
        link[i][1] = (handle[1] - at[i][1]) / PANTOGRAPH_DISTAL;
    }
    sine = link[0][0] * link[1][1] - link[0][1] * link[1][0];
    if (fabsf(sine) < LEAST_SINE)
        return;
    /* Each distal link pushes along itself; the motor feels the component across the proximal one. */
    for (i = 0; i < 2; i++) {
        const float *other = link[1 - i];
        const float push = (i == 0 ? 1.0f : -1.0f) * (force[0] * other[1] - force[1] * other[0]) / sine;
        torques[i] = PANTOGRAPH_PROXIMAL * push * (cosf(angles[i]) * link[i][1] - sinf(angles[i]) * link[i][0]);
    }
}

int pantograph_begin(const float angles[2])
{
    static const float box[4][2] = {{-0.01f, -0.01f}, {0.01f, -0.01f}, {0.01f, 0.01f}, {-0.01f, 0.01f}};
    static const stiction_surface surfaces[2] = {
        {.normal = {0.0f, 1.0f}, .offset = 0.07f, .friction_static = 0.6f, .friction_dynamic = 0.4f},
        {.normal = {-1.0f, 0.0f}, .offset = -0.05f, .friction_static = 0.6f, .friction_dynamic = 0.4f},
    };
    const stiction_scene scene = {
        .vertices = box,
        .vertex_count = 4,
        .start = {0.0f, 0.10f, 0.0f},
        .has_holding_point = 1,
        .stiffness_translation = 400.0f,
        .stiffness_rotation = 0.1f,
        .surfaces = surfaces,
        .surface_count = 2,
    };
    float handle[2];
    stiction_hand hand = {.held = 1};
    int result = stiction_init(&solver, sizeof solver, STICTION_ABI, &scene, NULL);
    if (result != STICTION_RESULT_OK)
        return result;
    if (!pantograph_handle(angles, handle))
        return STICTION_RESULT_NOT_STARTED;
    hand.x = handle[0];
    hand.y = handle[1];
    return stiction_start(&solver, &hand, NULL);
}

void pantograph_tick(const float angles[2], float torques[2])
{
    float handle[2], force[2];
    stiction_hand hand = {.held = 1};
    stiction_wrench_on_body wrench;
    torques[0] = torques[1] = 0.0f;
    if (!pantograph_handle(angles, handle))
        return;
    hand.x = handle[0];
    hand.y = handle[1];
    if (stiction_step(&solver, &hand, NULL) != STICTION_RESULT_OK || stiction_wrench(&solver, &wrench) != STICTION_RESULT_OK)
        return;
    force[0] = -wrench.fx;
    force[1] = -wrench.fy;
    pantograph_torques(angles, force, torques);
}
