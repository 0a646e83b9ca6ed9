"""The snippets of ENGINES.md, with what stands in for the engines: they follow the program, and their C compiles."""

import math
import os
import re
import shutil
import signal
import socket
import struct
import subprocess
import sys
import time
import tomllib
import types

import pytest
from conftest import WORKSPACE

# The hand lifts the body of this scene off its table, to here: x, y (m), phi (rad).
SCENE = tomllib.loads((WORKSPACE / "host-sim/scenes/table-edge.toml").read_text(encoding="utf-8"))
LIFTED = (-0.1, 0.2, 0.0)
# How far the pose may be from that of the balance (m): there is no contact, so only digits of f32 and of the line are lost.
CLOSE = 1e-6


def lifted():
    """Where the hand's springs hold the body then: below the hand by the holding point and by what its weight stretches."""
    _, arm = SCENE["grasp"]["point"]
    sag = SCENE["body"]["weight"] / SCENE["spring"]["translation"]
    return LIFTED[0], LIFTED[1] - arm - sag


def snippet(engine, language):
    text = (WORKSPACE / "host-sim/ENGINES.md").read_text(encoding="utf-8")
    section = text.split(f"\n## {engine}\n")[1].split("\n## ")[0]
    return re.search(rf"```{language}\n(.*?)```", section, re.DOTALL)[1]


def module(monkeypatch, name, **content):
    made = types.ModuleType(name)
    vars(made).update(content)
    monkeypatch.setitem(sys.modules, name, made)
    return made


def free_port():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


@pytest.fixture
def ports(program, tmp_path):
    """The program in real time: its poses go to the first port, the hand comes by the second one."""
    to, by = free_port(), free_port()
    arguments = ["view", "table-edge", "--headless", "--listen", "127.0.0.1:0", "--recordings", tmp_path]
    view = subprocess.Popen(
        [program, *arguments, "--opentrack", f"127.0.0.1:{to}", "--opentrack-in", str(by)], stdout=subprocess.PIPE
    )
    view.stdout.readline()
    yield to, by
    view.send_signal(signal.SIGINT)
    view.communicate()


def test_blender_follows(ports, monkeypatch):
    to, by = ports
    timers = []
    body = types.SimpleNamespace(location=None, rotation_euler=None)
    app = types.SimpleNamespace(timers=types.SimpleNamespace(register=timers.append))
    module(monkeypatch, "bpy", app=app, context=types.SimpleNamespace(active_object=body))
    names = {}
    exec(snippet("Blender", "python").replace("4242", str(to)), names)
    (follow,) = timers
    x, y = lifted()
    end = time.monotonic() + 20
    with names["poses"], socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as hand:
        while body.location is None or math.hypot(body.location[0] - x, body.location[2] - y) > CLOSE:
            assert time.monotonic() < end, body.location
            pose = (100 * LIFTED[0], 100 * LIFTED[1], 3.0, 0, 0, math.degrees(LIFTED[2]))
            hand.sendto(struct.pack("<6d", *pose), ("127.0.0.1", by))
            time.sleep(follow())
    assert body.rotation_euler == pytest.approx((0, -LIFTED[2], 0), abs=CLOSE)


class Message(types.SimpleNamespace):
    """A message of ROS: its fields are there when they are asked for."""

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        setattr(self, name, Message())
        return getattr(self, name)


def test_ros_publishes_pose_and_wrench(monkeypatch):
    pytest.importorskip("stiction")
    published, subscribed = {}, {}

    class Node:
        def __init__(self, name):
            self.name = name

        def create_publisher(self, kind, topic, depth):
            published[topic] = []
            return types.SimpleNamespace(publish=published[topic].append)

        def create_subscription(self, kind, topic, callback, depth):
            subscribed[topic] = callback

    module(monkeypatch, "rclpy", init=lambda: None, spin=lambda node: None)
    module(monkeypatch, "rclpy.node", Node=Node)
    module(monkeypatch, "geometry_msgs")
    module(monkeypatch, "geometry_msgs.msg", PoseStamped=Message, WrenchStamped=Message)
    names = {"__name__": "__main__"}
    exec(snippet("ROS 2", "python"), names)

    def hand(x, y, turn):
        sample = Message(header="now")
        sample.pose.position = Message(x=x, y=y, z=0.03)
        sample.pose.orientation = Message(x=0.0, y=0.0, z=math.sin(turn / 2), w=math.cos(turn / 2))
        subscribed["/stiction/hand"](sample)

    _, x, y, phi = SCENE["hand"]["keyframes"][0][:4]
    hand(x, y, phi)
    hand(LIFTED[0], LIFTED[1], LIFTED[2])
    pose, wrench = published["/stiction/pose"][-1].pose, published["/stiction/wrench"][-1].wrench
    assert (pose.position.x, pose.position.y) == pytest.approx(lifted(), abs=CLOSE)
    assert (pose.position.z, pose.orientation.z, pose.orientation.w) == pytest.approx((0.03, 0, 1), abs=CLOSE)
    # In the air the hand bears the weight.
    assert (wrench.force.x, wrench.force.y) == pytest.approx((0, SCENE["body"]["weight"]), abs=1e-3)
    # Three turns, in samples of an eighth of one: what is published is an angle that goes on.
    for eighth in range(25):
        hand(LIFTED[0], LIFTED[1], eighth * math.tau / 8)
    assert published["/stiction/pose"][-1].pose.orientation.w == pytest.approx(math.cos(math.tau * 3 / 2), abs=1e-3)


XR = """
#pragma once
#include <stdint.h>
typedef uint64_t XrSpaceLocationFlags;
static const XrSpaceLocationFlags XR_SPACE_LOCATION_ORIENTATION_VALID_BIT = 1, XR_SPACE_LOCATION_POSITION_VALID_BIT = 2;
typedef struct { float x, y, z, w; } XrQuaternionf;
typedef struct { float x, y, z; } XrVector3f;
typedef struct { XrQuaternionf orientation; XrVector3f position; } XrPosef;
typedef struct { int type; void *next; XrSpaceLocationFlags locationFlags; XrPosef pose; } XrSpaceLocation;
"""
VRPN = """
#pragma once
#include <sys/time.h>
typedef double vrpn_float64;
struct vrpn_Connection { int mainloop(const timeval *timeout = nullptr); };
vrpn_Connection *vrpn_create_server_connection(int port = 3883);
int vrpn_gettimeofday(timeval *time, void *zone);
void vrpn_SleepMsecs(double milliseconds);
struct vrpn_Tracker_Server {
    vrpn_Tracker_Server(const char *name, vrpn_Connection *c, int sensors = 1);
    int report_pose(int sensor, timeval t, const vrpn_float64 position[3], const vrpn_float64 quaternion[4], unsigned service = 1);
    void mainloop();
};
"""


@pytest.mark.parametrize(
    ("engine", "language", "compiler", "standard", "headers"),
    [
        ("OpenXR", "c", "cc", "c11", {"openxr/openxr.h": XR}),
        ("VRPN", "cpp", "c++", "c++17", {"vrpn_Connection.h": VRPN, "vrpn_Tracker.h": VRPN}),
    ],
)
def test_it_compiles(tmp_path, engine, language, compiler, standard, headers):
    if shutil.which(compiler) is None:
        pytest.skip(f"there is no {compiler}")
    for number, (name, text) in enumerate(headers.items()):
        place = tmp_path / name
        place.parent.mkdir(exist_ok=True)
        # One header has what both of an engine have.
        place.write_text(text if number == 0 else f'#include "{next(iter(headers))}"\n')
    source = tmp_path / f"snippet.{language}"
    source.write_text(snippet(engine, language), encoding="utf-8")
    folders = [f"-I{tmp_path}", f"-I{WORKSPACE / 'firmware/c/include'}"]
    options = [f"-std={standard}", "-D_GNU_SOURCE", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", *folders]
    subprocess.run([compiler, *options, os.fspath(source)], check=True)
