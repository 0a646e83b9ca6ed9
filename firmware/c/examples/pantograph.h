/* A pantograph: two motors at one base, two proximal links on them, two distal links that meet at the handle. */
#ifndef PANTOGRAPH_H
#define PANTOGRAPH_H

#ifdef __cplusplus
extern "C" {
#endif

/* Lengths (m): half the distance of the motors, which are at (-HALF_BASE, 0) and (HALF_BASE, 0); links. */
#define PANTOGRAPH_HALF_BASE 0.020f
#define PANTOGRAPH_PROXIMAL 0.060f
#define PANTOGRAPH_DISTAL 0.090f

/* From the angles of the proximal links (rad, from +x counter-clockwise; left, right) to the handle (m). 0: the links do not meet. */
int pantograph_handle(const float angles[2], float handle[2]);

/* Torques (N m) of the motors that produce a force (N) at the handle; zero near the poses where the distal links are collinear. */
void pantograph_torques(const float angles[2], const float force[2], float torques[2]);

/* A box with a floor and a wall. Returns 0, or the error. */
int pantograph_begin(const float angles[2]);

/* A tick of the control loop: from the angles of the motors to their torques. */
void pantograph_tick(const float angles[2], float torques[2]);

#ifdef __cplusplus
}
#endif

#endif
