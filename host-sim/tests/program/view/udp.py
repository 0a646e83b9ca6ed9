"""The other end of the UDP of `stiction view`: prints what it hears as JSON lines, sends what it reads as such.

It knows OSC 1.0 and the six doubles of OpenTrack from their specifications, and uses the standard library alone.
"""

import json
import socket
import struct
import sys
import threading


def padded(data):
    """An OSC string: ends with a 0, and is as long as a multiple of 4."""
    data += b"\0"
    return data + b"\0" * (-len(data) % 4)


def string(data, at):
    end = data.index(b"\0", at)
    return data[at:end].decode(), at + len(padded(data[at:end]))


def message(data):
    address, at = string(data, 0)
    types, at = string(data, at)
    assert types[0] == ","
    values = []
    for kind in types[1:]:
        if kind == "s":
            value, at = string(data, at)
        else:
            value = struct.unpack_from({"i": ">i", "f": ">f"}[kind], data, at)[0]
            at += 4
        values.append(value)
    assert at == len(data)
    return address, values


def bundle(data):
    assert data[:8] == b"#bundle\0"
    heard, at = {}, 16
    while at < len(data):
        size = struct.unpack_from(">i", data, at)[0]
        address, values = message(data[at + 4 : at + 4 + size])
        heard.setdefault(address, []).append(values)
        at += 4 + size
    return heard


def encoded(wanted):
    if "raw" in wanted:
        return bytes.fromhex(wanted["raw"])
    if "types" in wanted:
        packed = {"f": ">f", "d": ">d", "i": ">i", "h": ">q"}
        values = [struct.pack(packed[kind], value) for kind, value in zip(wanted["types"], wanted["values"]) if kind in packed]
        return padded(wanted["address"].encode()) + padded(b"," + wanted["types"].encode()) + b"".join(values)
    if "pose" in wanted:
        return struct.pack(f"<{len(wanted['pose'])}d", *wanted["pose"])
    if "held" in wanted:
        return padded(b"/stiction/held") + padded(b",i") + struct.pack(">i", wanted["held"])
    return padded(b"/stiction/hand") + padded(b",fff") + struct.pack(">3f", *wanted["hand"])


def serve(line):
    for text in sys.stdin:
        wanted = json.loads(text)
        line.sendto(encoded(wanted), ("127.0.0.1", wanted["port"]))


line = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
line.bind(("127.0.0.1", 0))
threading.Thread(target=serve, args=(line,), daemon=True).start()
print(json.dumps({"port": line.getsockname()[1]}), flush=True)
while True:
    packet = line.recv(65536)
    if sys.argv[1] == "osc":
        print(json.dumps(bundle(packet)), flush=True)
    else:
        assert len(packet) == 48
        print(json.dumps({"pose": struct.unpack("<6d", packet)}), flush=True)
