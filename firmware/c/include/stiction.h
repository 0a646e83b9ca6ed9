#ifndef STICTION_H
#define STICTION_H

#include <stddef.h>
#include <stdint.h>

/*
 * stiction: contact of an object held in the hand, by statics alone. At every pose of the hand the object is where forces and moments
 * balance: it sticks, slips, tips, lands, jams.
 *
 *   stiction solver;
 *   stiction_init(&solver, sizeof solver, STICTION_ABI, &scene, NULL);
 *   stiction_start(&solver, &hand, &output);
 *   for (;;) { stiction_step(&solver, &hand, &output); stiction_wrench(&solver, &wrench); }
 *
 * SI units. The world frame is right-handed with y upwards; angles are in radians, counter-clockwise; forces are those on the body.
 * Define STICTION_FIXED for the library in fixed point (libstiction_fixed.a), STICTION_OBSTACLES for one with obstacles, STICTION_PLANE
 * for the small one with a single surface.
 * All functions return a stiction_result; they allocate nothing, wait for nothing and never abort. Only one thread at a time may use a
 * memory.
 */

// The maximum number of vertices of a body.
#define STICTION_VERTICES 8

#if defined(STICTION_PLANE)
// The maximum number of surfaces of a scene.
#define STICTION_SURFACES 1
#endif

#if !defined(STICTION_PLANE)
// The maximum number of surfaces of a scene.
#define STICTION_SURFACES 4
#endif

// The maximum number of obstacles of a scene.
#define STICTION_OBSTACLE_COUNT 8

// The maximum number of corners of all obstacles together.
#define STICTION_CORNERS 32

#if defined(STICTION_OBSTACLES)
// The size of the memory in words of 8 bytes.
#define STICTION_WORDS 512
#endif

#if (!defined(STICTION_OBSTACLES) && !defined(STICTION_PLANE))
// The size of the memory in words of 8 bytes.
#define STICTION_WORDS 144
#endif

#if (!defined(STICTION_OBSTACLES) && defined(STICTION_PLANE))
// The size of the memory in words of 8 bytes.
#define STICTION_WORDS 120
#endif

// The size of a snapshot in words of 8 bytes.
#define STICTION_SNAPSHOT_WORDS 72

#if (!defined(STICTION_FIXED) && !defined(STICTION_OBSTACLES) && !defined(STICTION_PLANE))
// What the library and the header must agree on: version 1.0, number type, room. `stiction_init` compares it.
#define STICTION_ABI 256
#endif

#if (defined(STICTION_FIXED) && !defined(STICTION_OBSTACLES) && !defined(STICTION_PLANE))
// What the library and the header must agree on: version 1.0, number type, room. `stiction_init` compares it.
#define STICTION_ABI 257
#endif

#if (!defined(STICTION_FIXED) && defined(STICTION_OBSTACLES))
// What the library and the header must agree on: version 1.0, number type, room. `stiction_init` compares it.
#define STICTION_ABI 258
#endif

#if (defined(STICTION_FIXED) && defined(STICTION_OBSTACLES))
// What the library and the header must agree on: version 1.0, number type, room. `stiction_init` compares it.
#define STICTION_ABI 259
#endif

#if (!defined(STICTION_FIXED) && !defined(STICTION_OBSTACLES) && defined(STICTION_PLANE))
// What the library and the header must agree on: version 1.0, number type, room. `stiction_init` compares it.
#define STICTION_ABI 260
#endif

#if (defined(STICTION_FIXED) && !defined(STICTION_OBSTACLES) && defined(STICTION_PLANE))
// What the library and the header must agree on: version 1.0, number type, room. `stiction_init` compares it.
#define STICTION_ABI 261
#endif

// At most this many events of a frame are reported.
#define STICTION_EVENTS 16

// At most this many contacts at a time.
#define STICTION_CONTACTS 8

// The result of a function. Unless it is `STICTION_RESULT_OK`, nothing was done and nothing written, except the error of a scene.
enum stiction_result
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // Success.
    STICTION_RESULT_OK = 0,
    // A pointer that must not be is null.
    STICTION_RESULT_NULL = -1,
    // A pointer is not aligned for what it points to.
    STICTION_RESULT_UNALIGNED = -2,
    // The library does not match the header: another version, number type, or with obstacles or without.
    STICTION_RESULT_ABI = -3,
    // The memory is smaller than `sizeof(stiction)`, or a snapshot smaller than `sizeof(stiction_snapshot)`.
    STICTION_RESULT_SIZE = -4,
    // The memory holds no solver: `stiction_init` has not been called, or has failed.
    STICTION_RESULT_NOT_INITIALISED = -5,
    // The solver has no run: `stiction_start` has not been called.
    STICTION_RESULT_NOT_STARTED = -6,
    // The scene cannot be used; `stiction_error` says why.
    STICTION_RESULT_SCENE = -7,
    // The choice does not exist.
    STICTION_RESULT_CHOICE = -8,
    // The snapshot holds no run of this library.
    STICTION_RESULT_NO_SNAPSHOT = -9,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum stiction_result stiction_result;
#else
typedef int32_t stiction_result;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// The contact state.
enum stiction_state
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint8_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // No contact.
    STICTION_STATE_NON_CONTACT,
    // One vertex on one surface.
    STICTION_STATE_SINGLE_VERTEX,
    // Two collinear contacts.
    STICTION_STATE_EDGE,
    // Two contacts on two surfaces.
    STICTION_STATE_TWO_VERTEX,
    // One vertex on two surfaces.
    STICTION_STATE_CORNER,
    // Three contacts or more.
    STICTION_STATE_LOCKED,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum stiction_state stiction_state;
#else
typedef uint8_t stiction_state;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// What limited an answer; a larger value is more severe.
enum stiction_status
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint8_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // Nothing.
    STICTION_STATUS_OK,
    // More than 128 events in a frame: the rest was one jump of the hand.
    STICTION_STATUS_EVENT_LIMIT,
    // The hand is tilted so far out of the plane that its angle is hardly known.
    STICTION_STATUS_TWIST,
    // A search ended at its bound.
    STICTION_STATUS_ITERATION_LIMIT,
    // Only reactions beyond 64 k_h L hold the body: it stays.
    STICTION_STATUS_JAMMED,
    // The budget was used up: the body is behind the hand, and goes on in the next step.
    STICTION_STATUS_BEHIND,
    // No motion is consistent with the friction: the body stays out of balance.
    STICTION_STATUS_AMBIGUOUS,
    // The hand is beyond the range of the numbers: the last pose is held.
    STICTION_STATUS_SATURATED,
    // The hand is not finite: the last pose is held.
    STICTION_STATUS_HELD_LAST,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum stiction_status stiction_status;
#else
typedef uint8_t stiction_status;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// What happened in a frame.
enum stiction_event
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint8_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // A vertex reached a surface.
    STICTION_EVENT_TOUCH,
    // A contact opened.
    STICTION_EVENT_LIFT,
    // A slip ended where friction is mu_d N.
    STICTION_EVENT_SLIP,
    // The body left an edge and turns about one of its vertices.
    STICTION_EVENT_TIP,
    // The body lies on an edge.
    STICTION_EVENT_LAND,
    // The balance folded and the body snapped to the next one.
    STICTION_EVENT_SNAP,
    // Three or more contacts fix the body.
    STICTION_EVENT_JAM,
    // A contact began to slide with the hand.
    STICTION_EVENT_SLIDE,
    // A contact that slid sticks again.
    STICTION_EVENT_STOP,
    // The hand took hold of the body.
    STICTION_EVENT_GRASP,
    // The hand let go of the body.
    STICTION_EVENT_RELEASE,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum stiction_event stiction_event;
#else
typedef uint8_t stiction_event;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// What touches what.
enum stiction_kind
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint8_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // Vertex `feature` of the body on surface `other`.
    STICTION_KIND_SURFACE,
    // Vertex `feature` of the body on side `part` of obstacle `other`.
    STICTION_KIND_SIDE,
    // Corner `part` of obstacle `other` on side `feature` of the body.
    STICTION_KIND_CORNER,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum stiction_kind stiction_kind;
#else
typedef uint8_t stiction_kind;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// The parameter of a scene that an error is about.
enum stiction_parameter
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint8_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // None: there is no error.
    STICTION_PARAMETER_NONE = 0,
    // The number of vertices.
    STICTION_PARAMETER_VERTEX_COUNT,
    // Vertex `index`: where it is, or that it makes the polygon not strictly convex or not counter-clockwise.
    STICTION_PARAMETER_VERTEX,
    // The start pose.
    STICTION_PARAMETER_START,
    // The weight.
    STICTION_PARAMETER_WEIGHT,
    // The holding point.
    STICTION_PARAMETER_HOLDING_POINT,
    // The reach of the grasp.
    STICTION_PARAMETER_REACH,
    // The translational stiffness.
    STICTION_PARAMETER_STIFFNESS_TRANSLATION,
    // The rotational stiffness.
    STICTION_PARAMETER_STIFFNESS_ROTATION,
    // The number of surfaces.
    STICTION_PARAMETER_SURFACE_COUNT,
    // The normal of surface `index`.
    STICTION_PARAMETER_NORMAL,
    // The offset of surface `index`.
    STICTION_PARAMETER_OFFSET,
    // The static friction of surface `index`.
    STICTION_PARAMETER_FRICTION_STATIC,
    // The dynamic friction of surface `index`.
    STICTION_PARAMETER_FRICTION_DYNAMIC,
    // The memory length of surface `index`.
    STICTION_PARAMETER_MEMORY,
    // At the start vertex `second` is inside surface `index`.
    STICTION_PARAMETER_PENETRATION,
    // The number of obstacles.
    STICTION_PARAMETER_OBSTACLE_COUNT,
    // The number of corners of all obstacles together.
    STICTION_PARAMETER_CORNER_COUNT,
    // The number of corners of obstacle `index`.
    STICTION_PARAMETER_CORNERS,
    // Corner `second` of obstacle `index`.
    STICTION_PARAMETER_CORNER,
    // The length of side `second` of obstacle `index`.
    STICTION_PARAMETER_SIDE,
    // The static friction of obstacle `index`.
    STICTION_PARAMETER_OBSTACLE_FRICTION_STATIC,
    // The dynamic friction of obstacle `index`.
    STICTION_PARAMETER_OBSTACLE_FRICTION_DYNAMIC,
    // The memory length of obstacle `index`.
    STICTION_PARAMETER_OBSTACLE_MEMORY,
    // At the start the body is inside obstacle `index`.
    STICTION_PARAMETER_OVERLAP,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum stiction_parameter stiction_parameter;
#else
typedef uint8_t stiction_parameter;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// A solver with its run. Its contents are private; to move it, copy the whole.
typedef struct stiction {
    // Private.
    uint64_t words[STICTION_WORDS];
} stiction;

// A fixed half-plane. It has no ends and does not move.
typedef struct stiction_surface {
    // Its normal, which points to the free side; of any length but 0.
    float normal[2];
    // Its position b (m): the free side is n.p >= b, with n of length 1.
    float offset;
    // Coefficient of static friction, not less than that of dynamic friction.
    float friction_static;
    // Coefficient of dynamic friction, 0 or more. If it equals the static one contacts slide steadily, if it is smaller they stick and
    // slip.
    float friction_dynamic;
    // Memory length D_c (m), 0 or more: if the normal force is at least k_h D_c / (mu_s - mu_d) a contact sticks and slips, if it is less
    // it slides. Only with `has_memory`; without, D_c is 1/4096 of the size of the body.
    float memory;
    // Not 0: `memory` applies.
    uint8_t has_memory;
} stiction_surface;

// A fixed obstacle: a convex polygon, a thin wall or a pin. Only in a library with obstacles.
typedef struct stiction_obstacle {
    // Its corners (m), counter-clockwise: a strictly convex polygon, two for a thin wall, one for a pin.
    const float (*vertices)[2];
    // The number of corners.
    uint32_t vertex_count;
    // As for a surface.
    float friction_static;
    // As for a surface.
    float friction_dynamic;
    // As for a surface.
    float memory;
    // Not 0: `memory` applies.
    uint8_t has_memory;
} stiction_obstacle;

// A scene. It is copied: nothing of it is needed after `stiction_init` has returned. Members that are not named in an initialiser are 0,
// which is a usable choice for all except vertices and stiffness.
typedef struct stiction_scene {
    // The body's vertices (m), in its own frame: a point, a rod of two, or a strictly convex polygon, counter-clockwise.
    const float (*vertices)[2];
    // The number of vertices: 1 to `STICTION_VERTICES`.
    uint32_t vertex_count;
    // Start pose: x, y (m), theta (rad) of the body's frame in the world. No vertex is deeper in a surface than 1e-5 of the body's size.
    float start[3];
    // Weight (N), 0 or more, at the centroid, along -y.
    float weight;
    // The point at which the hand holds the body first (m), in the body's frame. Only with `has_holding_point`.
    float holding_point[2];
    // Not 0: `holding_point` applies. 0: the hand takes hold where it is.
    uint8_t has_holding_point;
    // How far outside the body a hand may be and still take hold (m), 0 or more.
    float reach;
    // Translational stiffness k_h (N/m), more than 0: the hand pulls the holding point with k_h times its displacement.
    float stiffness_translation;
    // Rotational stiffness k_theta (N m/rad), 0 or more: the hand turns the body with k_theta times the difference of angles.
    float stiffness_rotation;
    // The surfaces; may be null if there are none.
    const struct stiction_surface *surfaces;
    // The number of surfaces: at most `STICTION_SURFACES`.
    uint32_t surface_count;
    // The obstacles; null if there are none, and in a library without obstacles.
    const struct stiction_obstacle *obstacles;
    // The number of obstacles: at most `STICTION_OBSTACLES`, with at most `STICTION_CORNERS` corners together; 0 in a library without
    // obstacles.
    uint32_t obstacle_count;
} stiction_scene;

// Why a scene cannot be used. `stiction_error_text` turns it into a sentence.
typedef struct stiction_error {
    // Which parameter: a `stiction_parameter`.
    uint8_t parameter;
    // Index of the vertex, surface or obstacle that it belongs to, from 0; 0 if there is none.
    uint8_t index;
    // Index of the vertex, corner or side in it, from 0; 0 if there is none.
    uint8_t second;
    // Its value, in the unit of the parameter; for a count the count, for a penetration or an overlap the depth (m).
    float value;
    // What is allowed, in words, and its number of bytes: it is not terminated by 0.
    const uint8_t *allowed;
    // See `allowed`.
    size_t allowed_length;
} stiction_error;

// A sample of the hand.
typedef struct stiction_hand {
    // Position (m).
    float x;
    // Position (m).
    float y;
    // Angle (rad), unwrapped: it goes on beyond a turn.
    float phi;
    // Whole turns that are added to it: with many turns in `phi` alone few digits would be left.
    int32_t turns;
    // Depth across the plane (m); it is passed through.
    float depth;
    // Not 0: the hand holds the body, or takes hold as soon as it is within reach.
    uint8_t held;
} stiction_hand;

// The answer of a step.
typedef struct stiction_output {
    // Position of the origin of the body's frame (m).
    float x;
    // Position of the origin of the body's frame (m).
    float y;
    // Angle of the body (rad), in [-pi, pi], to which `turns` whole turns are added.
    float theta;
    // Whole turns of the body.
    int32_t turns;
    // Depth of the hand (m).
    float depth;
    // The longest slip of the frame (m); 0 without one.
    float longest_slip;
    // The fraction of the hand's displacement that is left to follow, 0 to 1; more than 0 if the budget was used up.
    float behind;
    // Slips that ended in this frame.
    uint32_t slips;
    // Units of work that the step took.
    uint32_t work;
    // 1: the hand holds the body.
    uint8_t held;
    // The contact state.
    stiction_state state;
    // What limited the answer.
    stiction_status status;
    // The number of events.
    uint8_t event_count;
    // What happened, in order; a run of equal events is reported once.
    stiction_event events[STICTION_EVENTS];
} stiction_output;

// Force and moment of the hand on the body. A haptic device outputs the opposite to the hand.
typedef struct stiction_wrench_on_body {
    // Force at the holding point (N).
    float fx;
    // Force at the holding point (N).
    float fy;
    // Moment about the holding point (N m), counter-clockwise.
    float moment;
} stiction_wrench_on_body;

// A contact.
typedef struct stiction_contact {
    // Its position (m).
    float x;
    // Its position (m).
    float y;
    // Normal force (N), 0 or more.
    float normal;
    // Friction on the body (N) along the tangent t = (n_y, -n_x), which is +x on a floor.
    float friction;
    // 0: it sticks; 1 or -1: it slides with the hand along t or against it.
    int8_t sliding;
    // What touches what.
    stiction_kind kind;
    // Index of the body's vertex or side, from 0.
    uint8_t feature;
    // Index of the surface or obstacle, from 0.
    uint8_t other;
    // Index of the obstacle's side or corner, from 0; 0 on a surface.
    uint8_t part;
} stiction_contact;

// A saved state of a run.
typedef struct stiction_snapshot {
    // Private.
    uint64_t words[STICTION_SNAPSHOT_WORDS];
} stiction_snapshot;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// Builds a solver for a scene, in memory of the caller.
//
// size: `sizeof(stiction)`, abi: `STICTION_ABI`. error: receives what is wrong with the scene if the result is `STICTION_RESULT_SCENE`;
// may be null. The evolution is `path`, and there is no budget.
stiction_result stiction_init(struct stiction *memory,
                              size_t size,
                              uint32_t abi,
                              const struct stiction_scene *scene,
                              struct stiction_error *error);

// Chooses how frames are evolved: 0, `path`, exact events along the straight path of the hand, whatever the frame rate; 1, `frame`, cheaper:
// from the first event on the hand jumps to the end of the frame.
stiction_result stiction_set_evolution(struct stiction *memory,
                                       uint8_t evolution);

// Bounds the work of a step, in units (the README says what one costs); `UINT32_MAX`: no bound. A step that would take more leaves the
// body behind the hand, and the next one goes on from there.
stiction_result stiction_set_budget(struct stiction *memory,
                                    uint32_t units);

// Starts a new run: the body at its start pose, with the hand at its first pose. output: may be null.
stiction_result stiction_start(struct stiction *memory,
                               const struct stiction_hand *hand,
                               struct stiction_output *output);

// One frame: the hand moves to its new pose, and the body follows. A sample that is not finite leaves the body as it is, and the status of
// the output reports it. output: may be null.
stiction_result stiction_step(struct stiction *memory,
                              const struct stiction_hand *hand,
                              struct stiction_output *output);

// Force and moment of the hand on the body; zero while it is not held. A device outputs the opposite to the hand.
stiction_result stiction_wrench(const struct stiction *memory,
                                struct stiction_wrench_on_body *wrench);

// The contacts with their forces: written to `contacts`, which has room for `STICTION_CONTACTS`; their number is written to `count`.
stiction_result stiction_contacts(const struct stiction *memory,
                                  struct stiction_contact *contacts,
                                  uint32_t *count);

// Saves the present state of a run.
stiction_result stiction_take_snapshot(const struct stiction *memory, struct stiction_snapshot *snapshot);

// Restores a saved state of a run: the same hands lead to the same bits again. The snapshot must be of the same scene.
stiction_result stiction_restore(struct stiction *memory,
                                 const struct stiction_snapshot *snapshot);

// The meaning of a result, and for `STICTION_RESULT_SCENE` what is wrong: `<parameter>, allowed: <what>`. The text ends with 0, and is cut
// if `size` bytes are too few. error: as `stiction_init` has written it, or null.
stiction_result stiction_error_text(int32_t result,
                                    const struct stiction_error *error,
                                    char *text,
                                    size_t size);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* STICTION_H */
