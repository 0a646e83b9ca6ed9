"""A client of `stiction view`: prints poses; with --drag, it also moves the hand.

    cargo run --release -- view --headless
    python3 host-sim/examples/view_client.py [--drag] [--rate HZ] [--seconds S] [HOST:PORT]

It needs only the standard library. host-sim/VIEW.md describes the messages on the socket.
"""

import argparse
import base64
import hashlib
import json
import os
import socket
import struct
import threading
import time

MAGIC = "258EAFA5-E914-47DA-95CA-C5AB0DC85B11"


class WebSocket:
    """RFC 6455 from the client's side, text messages only."""

    def __init__(self, place):
        host, port = place.rsplit(":", 1)
        self.stream = socket.create_connection((host.strip("[]"), int(port)))
        self.stream.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.rest = self.stream.makefile("rb")
        key = base64.b64encode(os.urandom(16)).decode()
        self.stream.sendall(
            f"GET /ws HTTP/1.1\r\nHost: {place}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
            f"Sec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n\r\n".encode()
        )
        status = self.rest.readline().decode()
        if " 101 " not in status:
            raise ConnectionError(status.strip())
        accepted = base64.b64encode(hashlib.sha1((key + MAGIC).encode()).digest()).decode()
        while (line := self.rest.readline().decode().strip()) != "":
            name, _, value = line.partition(": ")
            if name.lower() == "sec-websocket-accept" and value != accepted:
                raise ConnectionError("the answer belongs to another request")

    def frame(self, kind, data):
        """Sends a frame, masked as required of clients."""
        mask = os.urandom(4)
        length = len(data)
        head = bytes([0x80 | kind])
        head += bytes([0x80 | length]) if length < 126 else bytes([0xFE]) + struct.pack(">H", length)
        masked = bytes(byte ^ mask[i % 4] for i, byte in enumerate(data))
        self.stream.sendall(head + mask + masked)

    def send(self, message):
        """Sends an object as JSON."""
        self.frame(1, json.dumps(message).encode())

    def receive(self):
        """The next message; None at the end."""
        text = b""
        while True:
            head = self.rest.read(2)
            if len(head) < 2:
                return None
            kind, length = head[0] & 15, head[1] & 127
            if length == 126:
                (length,) = struct.unpack(">H", self.rest.read(2))
            elif length == 127:
                (length,) = struct.unpack(">Q", self.rest.read(8))
            data = self.rest.read(length)
            if kind == 8:
                return None
            if kind == 9:
                self.frame(10, data)
            if kind in (0, 1):
                text += data
                if head[0] & 0x80:
                    return json.loads(text)


def drag(line, home):
    """Presses the body down from the hand's start pose, and drags it back and forth."""
    x, y, phi = home
    begun = time.monotonic()
    while True:
        t = time.monotonic() - begun
        down = min(t, 1.0) * 0.03
        along = 0.05 * max(0.0, 1.0 - abs((t % 8.0) / 4.0 - 1.0)) if t > 1.0 else 0.0
        line.send({"type": "hand", "pose": [x + along, y - down, phi], "held": True, "sent": t})
        time.sleep(0.01)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("place", nargs="?", default="127.0.0.1:8405")
    parser.add_argument("--drag", action="store_true", help="move the hand")
    parser.add_argument("--rate", type=float, default=10.0, help="frames per second")
    parser.add_argument("--seconds", type=float, default=float("inf"), help="duration in seconds")
    args = parser.parse_args()
    line = WebSocket(args.place)
    line.send({"type": "rate", "value": args.rate})
    begun, leads = time.monotonic(), False
    while (message := line.receive()) is not None and time.monotonic() - begun < args.seconds:
        if message["type"] == "error":
            print("refused:", message["message"])
        elif message["type"] == "state":
            scene = message["scene"]
            print("scene", scene["title"], "hand by", message["hand"]["by"])
            if args.drag and not leads:
                leads = True
                threading.Thread(target=drag, args=(line, scene["home"]), daemon=True).start()
        elif message["type"] == "frame":
            frame, counts = message["frame"], message["counts"]
            x, y, theta = frame["pose"]
            print(
                f"{frame['t']:9.3f} s  x {1e3 * x:8.3f} mm  y {1e3 * y:8.3f} mm  theta {theta:8.4f} rad  "
                f"{frame['state']:<13} slips {counts['slips']}  missed {counts['missed']} of {counts['ticks']}",
                flush=True,
            )


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        pass
    except OSError as error:
        raise SystemExit(f"no `stiction view` answers: {error}; start one with: cargo run --release -- view --headless")
