/* Invalid arguments: each is refused with its code, and nothing is written. Run under sanitizers. */
#include "stiction.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static int failures;

static void expect(int result, int expected, int line)
{
    if (result != expected) {
        printf("hostile.c:%d: %d, expected %d\n", line, result, expected);
        failures++;
    }
}
#define EXPECT(result, expected) expect((int)(result), (int)(expected), __LINE__)

static const float box[4][2] = {{-0.05f, -0.03f}, {0.05f, -0.03f}, {0.05f, 0.03f}, {-0.05f, 0.03f}};
static const stiction_surface floor_ = {.normal = {0, 1}, .friction_static = 0.5f, .friction_dynamic = 0.3f};
static const stiction_scene good = {
    .vertices = box,
    .vertex_count = 4,
    .start = {0, 0.03f, 0},
    .has_holding_point = 1,
    .stiffness_translation = 500,
    .stiffness_rotation = 0.5f,
    .surfaces = &floor_,
    .surface_count = 1,
};
static const stiction_hand hand = {.y = 0.03f, .held = 1};

/* An address that is not aligned for anything. */
#define UNALIGNED(type, place) ((type *)(void *)((char *)(place) + 1))

static void before_a_run(stiction *solver)
{
    stiction_output output;
    stiction_wrench_on_body wrench;
    stiction_snapshot snapshot;
    EXPECT(stiction_step(solver, &hand, &output), STICTION_RESULT_NOT_INITIALISED);
    EXPECT(stiction_start(solver, &hand, &output), STICTION_RESULT_NOT_INITIALISED);
    EXPECT(stiction_init(NULL, sizeof *solver, STICTION_ABI, &good, NULL), STICTION_RESULT_NULL);
    EXPECT(stiction_init(solver, sizeof *solver, STICTION_ABI, NULL, NULL), STICTION_RESULT_NULL);
    EXPECT(stiction_init(solver, sizeof *solver - 1, STICTION_ABI, &good, NULL), STICTION_RESULT_SIZE);
    EXPECT(stiction_init(solver, 0, STICTION_ABI, &good, NULL), STICTION_RESULT_SIZE);
    EXPECT(stiction_init(solver, sizeof *solver, STICTION_ABI ^ 1, &good, NULL), STICTION_RESULT_ABI);
    EXPECT(stiction_step(solver, &hand, &output), STICTION_RESULT_NOT_INITIALISED);
    EXPECT(stiction_init(solver, sizeof *solver, STICTION_ABI, &good, NULL), STICTION_RESULT_OK);
    EXPECT(stiction_step(solver, &hand, &output), STICTION_RESULT_NOT_STARTED);
    EXPECT(stiction_wrench(solver, &wrench), STICTION_RESULT_NOT_STARTED);
    EXPECT(stiction_take_snapshot(solver, &snapshot), STICTION_RESULT_NOT_STARTED);
}

static void in_a_run(stiction *solver)
{
    stiction_output outputs[2];
    stiction_wrench_on_body wrenches[2];
    stiction_contact contacts[STICTION_CONTACTS + 1];
    stiction_snapshot snapshot;
    stiction_hand lost = hand;
    uint32_t counts[2];
    EXPECT(stiction_start(solver, &hand, NULL), STICTION_RESULT_OK);
    EXPECT(stiction_step(solver, NULL, NULL), STICTION_RESULT_NULL);
    EXPECT(stiction_step(solver, &hand, UNALIGNED(stiction_output, outputs)), STICTION_RESULT_UNALIGNED);
    EXPECT(stiction_wrench(solver, NULL), STICTION_RESULT_NULL);
    EXPECT(stiction_wrench(solver, UNALIGNED(stiction_wrench_on_body, wrenches)), STICTION_RESULT_UNALIGNED);
    EXPECT(stiction_contacts(solver, NULL, counts), STICTION_RESULT_NULL);
    EXPECT(stiction_contacts(solver, contacts, NULL), STICTION_RESULT_NULL);
    EXPECT(stiction_contacts(solver, UNALIGNED(stiction_contact, contacts), counts), STICTION_RESULT_UNALIGNED);
    EXPECT(stiction_contacts(solver, contacts, UNALIGNED(uint32_t, counts)), STICTION_RESULT_UNALIGNED);
    EXPECT(stiction_set_evolution(solver, 2), STICTION_RESULT_CHOICE);
    EXPECT(stiction_set_budget(NULL, 1), STICTION_RESULT_NULL);
    memset(&snapshot, 0, sizeof snapshot);
    EXPECT(stiction_restore(solver, &snapshot), STICTION_RESULT_NO_SNAPSHOT);
    EXPECT(stiction_restore(solver, NULL), STICTION_RESULT_NULL);
    lost.x = NAN;
    EXPECT(stiction_step(solver, &lost, outputs), STICTION_RESULT_OK);
    EXPECT(outputs[0].status, STICTION_STATUS_HELD_LAST);
    lost.x = INFINITY;
    lost.phi = -INFINITY;
    EXPECT(stiction_step(solver, &lost, outputs), STICTION_RESULT_OK);
    EXPECT(outputs[0].status, STICTION_STATUS_HELD_LAST);
    EXPECT(stiction_set_budget(solver, 0), STICTION_RESULT_OK);
    EXPECT(stiction_step(solver, &hand, outputs), STICTION_RESULT_OK);
}

/* A scene that is refused, the parameter that is named, and the same with every number replaced by one that is not finite. */
static void scenes(stiction *solver)
{
    stiction_error error;
    stiction_scene scene = good;
    char text[160], small[8];
    scene.stiffness_translation = NAN;
    EXPECT(stiction_init(solver, sizeof *solver, STICTION_ABI, &scene, &error), STICTION_RESULT_SCENE);
    EXPECT(error.parameter, STICTION_PARAMETER_STIFFNESS_TRANSLATION);
    EXPECT(stiction_error_text(STICTION_RESULT_SCENE, &error, text, sizeof text), STICTION_RESULT_OK);
    EXPECT(strlen(text) > 8, 1);
    EXPECT(stiction_error_text(STICTION_RESULT_SCENE, &error, small, sizeof small), STICTION_RESULT_OK);
    EXPECT(memchr(small, 0, sizeof small) != NULL, 1);
    EXPECT(stiction_error_text(STICTION_RESULT_SCENE, &error, NULL, 8), STICTION_RESULT_NULL);
    scene = good;
    scene.vertex_count = UINT32_MAX;
    EXPECT(stiction_init(solver, sizeof *solver, STICTION_ABI, &scene, &error), STICTION_RESULT_SCENE);
    EXPECT(error.parameter, STICTION_PARAMETER_VERTEX_COUNT);
    scene = good;
    scene.surface_count = UINT32_MAX;
    EXPECT(stiction_init(solver, sizeof *solver, STICTION_ABI, &scene, &error), STICTION_RESULT_SCENE);
    EXPECT(error.parameter, STICTION_PARAMETER_SURFACE_COUNT);
    scene = good;
    scene.vertex_count = 0;
    EXPECT(stiction_init(solver, sizeof *solver, STICTION_ABI, &scene, &error), STICTION_RESULT_SCENE);
    EXPECT(error.parameter, STICTION_PARAMETER_VERTEX_COUNT);
    scene = good;
    scene.vertices = NULL;
    EXPECT(stiction_init(solver, sizeof *solver, STICTION_ABI, &scene, &error), STICTION_RESULT_NULL);
    scene = good;
    scene.surfaces = NULL;
    EXPECT(stiction_init(solver, sizeof *solver, STICTION_ABI, &scene, NULL), STICTION_RESULT_NULL);
    scene.surfaces = UNALIGNED(stiction_surface, &floor_);
    EXPECT(stiction_init(solver, sizeof *solver, STICTION_ABI, &scene, NULL), STICTION_RESULT_UNALIGNED);
}

int main(void)
{
    static stiction two[2], copied;
    stiction_snapshot snapshot;
    stiction_output before, after;
    before_a_run(&two[0]);
    EXPECT(stiction_init(UNALIGNED(stiction, two), sizeof *two, STICTION_ABI, &good, NULL), STICTION_RESULT_UNALIGNED);
    EXPECT(stiction_init(two, sizeof *two, STICTION_ABI, &good, NULL), STICTION_RESULT_OK);
    in_a_run(two);
    /* A refused scene leaves the solver and its run as they were. */
    EXPECT(stiction_take_snapshot(two, &snapshot), STICTION_RESULT_OK);
    memcpy(&copied, two, sizeof copied);
    scenes(two);
    EXPECT(memcmp(&copied, two, sizeof copied), 0);
    EXPECT(stiction_step(two, &hand, &before), STICTION_RESULT_OK);
    EXPECT(stiction_restore(&copied, &snapshot), STICTION_RESULT_OK);
    EXPECT(stiction_step(&copied, &hand, &after), STICTION_RESULT_OK);
    EXPECT(before.x == after.x && before.y == after.y && before.theta == after.theta, 1);
    return failures != 0;
}
