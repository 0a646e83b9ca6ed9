// A knob with detents that stick and slip: a motor behind an H bridge, and an absolute encoder with an analogue output on its axle.
#include <Stiction.h>

extern "C" int knob_begin(void);
extern "C" float knob_tick(float angle, stiction_output *output);

const int ENCODER = A0;
const int SPEED = 9;      // PWM of the H bridge
const int DIRECTION = 8;  // high: clockwise
const float TORQUE = 0.05f;  // of the motor at full PWM (N m)
const unsigned long TICK = 1000;  // us

unsigned long next_tick;

// The angle of the knob (rad), unwrapped.
float angle() {
    static int last = analogRead(ENCODER);
    static long turns = 0;
    const int now = analogRead(ENCODER);
    if (now - last > 512) turns--;
    if (last - now > 512) turns++;
    last = now;
    return (turns * 1024 + now) * (2.0f * 3.14159265f / 1024.0f);
}

void setup() {
    pinMode(SPEED, OUTPUT);
    pinMode(DIRECTION, OUTPUT);
    while (knob_begin() != STICTION_RESULT_OK) {
    }
    next_tick = micros();
}

void loop() {
    if ((long)(micros() - next_tick) < 0) return;
    next_tick += TICK;
    const float torque = knob_tick(angle(), NULL) / TORQUE;
    const float part = torque < 0.0f ? -torque : torque;
    digitalWrite(DIRECTION, torque < 0.0f ? HIGH : LOW);
    analogWrite(SPEED, part < 1.0f ? (int)(255.0f * part) : 255);
}
