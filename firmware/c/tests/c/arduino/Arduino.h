// The subset of Arduino that the sketches use, on a computer.
#ifndef ARDUINO_H
#define ARDUINO_H

enum { OUTPUT = 1, LOW = 0, HIGH = 1, A0 = 14, A1 = 15 };

void pinMode(int pin, int mode);
void digitalWrite(int pin, int level);
void analogWrite(int pin, int duty);
int analogRead(int pin);
unsigned long micros();

#endif
