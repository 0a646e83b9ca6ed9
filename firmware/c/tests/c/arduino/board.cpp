// A sketch with encoders that turn back and forth, ten seconds long: checks that its motors output a torque at some time, and never more than the maximum.
#include "Arduino.h"

#include SKETCH

static unsigned long now;
static int greatest;

void pinMode(int, int) {}
void digitalWrite(int, int) {}

void analogWrite(int, int duty) {
    if (duty > greatest || duty < 0) greatest = duty < 0 ? 256 : duty;
}

// From a pose in which the links of a pantograph meet above the floor to one in which they press on it, and back.
int analogRead(int pin) {
    const int time = static_cast<int>(now / 20000 % 200);
    const int swing = time < 100 ? time : 200 - time;
    return pin == A1 ? 150 - swing : 360 + swing;
}

unsigned long micros() {
    return now;
}

int main() {
    setup();
    for (; now < 10000000; now += 500) loop();
    return greatest > 0 && greatest < 256 ? 0 : 1;
}
