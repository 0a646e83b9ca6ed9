// A pantograph that holds a box: two motors behind H bridges, each with an absolute encoder with an analogue output.
#include <Stiction.h>

#include "pantograph.h"

const int ENCODERS[2] = {A0, A1};
const int SPEEDS[2] = {9, 10};      // PWM of the H bridges
const int DIRECTIONS[2] = {7, 8};   // high: clockwise
const float TORQUE = 0.1f;          // of a motor at full PWM (N m)
const unsigned long TICK = 1000;    // us

unsigned long next_tick;
bool begun;

void read_angles(float angles[2]) {
    for (int i = 0; i < 2; i++) angles[i] = analogRead(ENCODERS[i]) * (2.0f * 3.14159265f / 1024.0f);
}

void setup() {
    for (int i = 0; i < 2; i++) {
        pinMode(SPEEDS[i], OUTPUT);
        pinMode(DIRECTIONS[i], OUTPUT);
    }
    next_tick = micros();
}

void loop() {
    if ((long)(micros() - next_tick) < 0) return;
    next_tick += TICK;
    float angles[2], torques[2];
    read_angles(angles);
    if (!begun) {
        begun = pantograph_begin(angles) == STICTION_RESULT_OK;
        return;
    }
    pantograph_tick(angles, torques);
    for (int i = 0; i < 2; i++) {
        const float torque = torques[i] / TORQUE;
        const float part = torque < 0.0f ? -torque : torque;
        digitalWrite(DIRECTIONS[i], torque < 0.0f ? HIGH : LOW);
        analogWrite(SPEEDS[i], part < 1.0f ? (int)(255.0f * part) : 255);
    }
}
