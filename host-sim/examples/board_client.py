#!/usr/bin/env python3
"""A minimal client of a stiction board, written from core/wire/FRAME.md with the standard library alone.

    board_client.py ADDRESS [SECONDS [BAUD]]
        says hello, moves the hand in a circle for 5 s, prints the board's messages; the address is a serial port (not
        on Windows), tcp:HOST:PORT or unix:PATH
    board_client.py --decode                     reads lines of hex from standard input, prints their frames as JSON
    board_client.py --encode                     the inverse

A message is a dictionary with the field names of FRAME.md; codes are numbers, lists are vertex_0, vertex_1, ...
In JSON a float that is not finite is a string: "nan", "inf", "-inf".
"""

import json
import math
import os
import re
import select
import socket
import struct
import sys
import time
import zlib

VERSION = 4
PARAMETERS = ("ffffBf", "k_h k_theta mu_s mu_d has_memory memory")
KNOB = ("fffIBfffBf", "origin_x origin_y radius counts_per_turn encoder_reversed torque_constant full_current torque_limit"
        " motor_reversed damping")
MODE = ("BBBBBHHHH", "evolution stepping axis_x axis_y events tick_rate pose_every forces_every health_every")

# name: type, layout in the notation of the module struct, the fields, and the variable part after them
LAYOUTS = {
    "hand": (0x01, "fffifB", "x y phi turns depth held", None),
    "tracker": (0x02, "fffffffB", "x y z qx qy qz qw held", None),
    "parameters": (0x03, *PARAMETERS, None),
    "scene": (0x04, "BBBBBfffffffff", "vertices surfaces obstacles corners has_point start_x start_y start_theta weight point_x"
              " point_y reach k_h k_theta", [("vertices", "vertex", "ff"), ("surfaces", "surface", "fffffBf"),
                                             ("obstacles", "obstacle", "BffBf"), ("corners", "corner", "ff")]),
    "mode": (0x05, *MODE, None),
    "hello": (0x06, "", "", None),
    "ping": (0x07, "", "", None),
    "reset": (0x08, "B", "what", None),
    "knob": (0x09, *KNOB, None),
    "ask-knob": (0x0a, "", "", None),
    "pose": (0x80, "ffffBHB", "x y theta depth flags events sample", None),
    "forces": (0x90, "ffffffiB", "wrench_x wrench_y wrench_m hand_x hand_y hand_m turns contacts",
               [("contacts", "contact", "BBBffffffb")]),
    "events": (0x91, "IfB", "slips longest_slip events", [("events", "event", "B")]),
    "reply": (0x92, "BBBBBBff", "command command_sequence reason subject index index2 value limit", "allowed"),
    "info": (0x93, "BBBBBBBBHHIff" + PARAMETERS[0] + MODE[0], "major minor patch number vertices surfaces corners actuators"
             " longest_frame fastest_tick budget stiffest_k_h stiffest_k_theta " + PARAMETERS[1] + " " + MODE[1], "name"),
    "health": (0x94, "B" + 15 * "I", "drive ticks missed_ticks samples late_samples lost_frames unsent worst_step"
               " worst_tick too_long cobs crc version unknown_type length value", None),
    "pong": (0x95, "BI", "ping_sequence ping_time", None),
    "knob-info": (0x96, "B" + KNOB[0], "source " + KNOB[1], None),
}
STATES = ["non-contact", "single-vertex", "edge", "two-vertex", "corner", "locked"]
EVENTS = ["touch", "lift", "slip", "tip", "land", "snap", "jam", "slide", "stop", "grasp", "release"]


class Fault(Exception):
    """Why a frame is not accepted."""


def stuff(data):
    """Encodes data with COBS."""
    out = bytearray()
    for block in data.split(b"\0"):
        while len(block) >= 254:
            out += b"\xff" + block[:254]
            block = block[254:]
        out += bytes([len(block) + 1]) + block
    return bytes(out)


def unstuff(data):
    """Decodes data from COBS."""
    out, at = bytearray(), 0
    while at < len(data):
        code = data[at]
        if at + code > len(data):
            raise Fault("cobs")
        out += data[at + 1:at + code]
        at += code
        if code < 255 and at < len(data):
            out.append(0)
    return bytes(out)


def encode(message):
    """A message as a frame, including its delimiter."""
    kind, layout, fields, tail = LAYOUTS[message["type"]]
    values = dict(message)
    if message["type"] == "pose":
        kind |= message["state"]
        values["flags"] = message["status"] | message["held"] << 4 | message["force_off"] << 5
        values["events"] |= message["turns"] << 13
    payload = struct.pack("<" + layout, *(number(values[field]) for field in fields.split()))
    if isinstance(tail, str):
        payload += message[tail].encode("ascii")
    for count, item, shape in tail if isinstance(tail, list) else []:
        for i in range(message[count]):
            one = message[f"{item}_{i}"]
            payload += struct.pack("<" + shape, *map(number, one if isinstance(one, (list, tuple)) else [one]))
    frame = struct.pack("<BBBI", VERSION, kind, message["sequence"], message["time"]) + payload
    return stuff(frame + struct.pack("<I", zlib.crc32(frame))) + b"\0"


def number(value):
    """A number from JSON."""
    return float(value) if isinstance(value, str) else value


def plain(value):
    """A value for JSON."""
    if isinstance(value, (list, tuple)):
        return [plain(one) for one in value]
    return str(value) if isinstance(value, float) and not math.isfinite(value) else value


def decode(data):
    """The message between two delimiters; raises Fault."""
    frame = unstuff(data)
    if len(frame) < 4 or zlib.crc32(frame[:-4]) != struct.unpack("<I", frame[-4:])[0]:
        raise Fault("crc")
    if len(frame) < 7:
        raise Fault("length")
    if frame[0] != VERSION:
        raise Fault("version")
    if len(frame) < 11:
        raise Fault("length")
    _, kind, sequence, when = struct.unpack_from("<BBBI", frame)
    family = 0x80 if 0x80 <= kind <= 0x85 else kind
    known = [name for name, layout in LAYOUTS.items() if layout[0] == family]
    if not known:
        raise Fault("unknown-type")
    message = {"type": known[0], "sequence": sequence, "time": when}
    read_payload(message, frame[7:-4])
    if family == 0x80:
        flags, events = message.pop("flags"), message["events"]
        message.update(state=kind & 7, status=flags & 15, held=flags >> 4 & 1, force_off=flags >> 5 & 1, turns=events >> 13,
                       events=events & 0x1fff)
        require(flags < 64 and message["events"] < 1 << len(EVENTS))
    return message


def read_payload(message, payload):
    """The fields of a payload, into the message."""
    _, layout, fields, tail = LAYOUTS[message["type"]]
    layout = struct.Struct("<" + layout)
    if len(payload) < layout.size or tail is None and len(payload) > layout.size:
        raise Fault("length")
    message.update(zip(fields.split(), layout.unpack_from(payload)))
    rest = payload[layout.size:]
    if isinstance(tail, list):
        shapes = [(item, struct.Struct("<" + shape), message[count]) for count, item, shape in tail]
        if len(rest) != sum(shape.size * count for _, shape, count in shapes):
            raise Fault("length")
        for item, shape, count in shapes:
            for i in range(count):
                one = shape.unpack_from(rest)
                message[f"{item}_{i}"] = one if len(one) > 1 else one[0]
                rest = rest[shape.size:]
    elif isinstance(tail, str):
        require(re.fullmatch(rb"[ -~]*", rest) is not None)
        message[tail] = rest.decode("ascii")
    check_codes(message)


def require(holds):
    if not holds:
        raise Fault("value")


def check_codes(message):
    """Checks that flags and codes are defined."""
    most = {"has_point": 1, "has_memory": 1, "evolution": 1, "stepping": 1, "what": 1, "reason": 8, "number": 1, "actuators": 1, "drive": 2,
            "encoder_reversed": 1, "motor_reversed": 1, "source": 2}
    if message["type"] in ("hand", "tracker"):
        most["held"] = 1
    for field, limit in most.items():
        require(message.get(field, 0) <= limit)
    if "axis_x" in message:
        x, y = message["axis_x"], message["axis_y"]
        require(x < 8 and x & 3 < 3 and y < 8 and y & 3 < 3 and x & 3 != y & 3 and message["events"] <= 1)
    if message["type"] == "events":
        require(all(message[f"event_{i}"] < len(EVENTS) for i in range(message["events"])))
    if message["type"] == "scene":
        require(all(message[f"surface_{i}"][5] <= 1 for i in range(message["surfaces"])))
        obstacles = [message[f"obstacle_{i}"] for i in range(message["obstacles"])]
        require(all(one[3] <= 1 for one in obstacles) and sum(one[0] for one in obstacles) == message["corners"])
    if message["type"] == "forces":
        contacts = [message[f"contact_{i}"] for i in range(message["contacts"])]
        require(all(one[-1] in (-1, 0, 1) for one in contacts))
        require(all(one[0] < 128 or one[1] < 255 for one in contacts))
    require(message.get("subject", 0) in [*range(25), 32, 33, *range(48, 55)])


class Decoder:
    """Finds the frames in a stream of bytes."""

    def __init__(self):
        self.pending = bytearray()
        self.faults = {}

    def feed(self, data):
        """The messages that are complete with these bytes."""
        *frames, self.pending = (self.pending + data).split(b"\0")
        for frame in filter(None, frames):
            try:
                yield decode(bytes(frame))
            except Fault as fault:
                self.faults[str(fault)] = self.faults.get(str(fault), 0) + 1


def connect(address, baud):
    """Functions that read available bytes, with a timeout, and write."""
    if address.startswith(("tcp:", "unix:")):
        kind, place = address.split(":", 1)
        if kind == "unix":
            line = socket.socket(socket.AF_UNIX)
            line.connect(place)
        else:
            host, port = place.rsplit(":", 1)
            line = socket.create_connection((host, int(port)))
        file, write = line.fileno(), line.sendall
    else:
        import termios
        import tty
        file = os.open(address, os.O_RDWR | os.O_NOCTTY)
        tty.setraw(file)
        settings = termios.tcgetattr(file)
        settings[4] = settings[5] = getattr(termios, f"B{baud}")
        termios.tcsetattr(file, termios.TCSANOW, settings)
        line, write = None, lambda data: os.write(file, data)
    # The returned line keeps the socket open.
    return (lambda wait: os.read(file, 4096) if select.select([file], [], [], wait)[0] else b""), write, line


def show(message):
    if message["type"] != "pose":
        return print(message)
    happened = [name for bit, name in enumerate(EVENTS) if message["events"] >> bit & 1]
    print("{time:10d} µs  {x:9.5f} {y:9.5f} m  {theta:9.5f} rad ".format(**message), STATES[message["state"]], *happened)


def run(address, seconds=5.0, baud="115200", rate=200.0):
    """Says hello, moves the hand in a circle, prints what comes back."""
    read, write, _open = connect(address, baud)
    decoder, begin, sequence = Decoder(), time.monotonic(), 0
    write(b"\0" + encode({"type": "hello", "sequence": 0, "time": 0}))
    while (now := time.monotonic() - begin) < seconds:
        if now * rate >= sequence:
            sequence += 1
            x, y = 0.02 * math.sin(2 * math.pi * now / 2.5), 0.045 - 0.01 * math.sin(math.pi * now / 2.5)
            sample = {"type": "hand", "x": x, "y": y, "phi": 0.0, "turns": 0, "depth": 0.0, "held": 1}
            write(encode({**sample, "sequence": sequence % 256, "time": int(now * 1e6)}))
        for message in decoder.feed(read(0.001)):
            show(message)
    print("faults:", decoder.faults or "none")


def main(arguments):
    if arguments == ["--decode"]:
        for line in sys.stdin:
            decoder = Decoder()
            found = decoder.feed(bytes.fromhex(line))
            messages = [{field: plain(value) for field, value in message.items()} for message in found]
            print(json.dumps({"messages": messages, "faults": decoder.faults}, allow_nan=False))
    elif arguments == ["--encode"]:
        for line in sys.stdin:
            print(encode(json.loads(line)).hex(" "))
    elif 1 <= len(arguments) <= 3 and not arguments[0].startswith("-"):
        run(arguments[0], *map(float, arguments[1:2]), *arguments[2:])
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main(sys.argv[1:])
