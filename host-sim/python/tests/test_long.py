"""Work of any length: Ctrl-C ends it within 0.1 s, too little memory is a MemoryError, and the solver is where it was."""

import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
import stiction

#: Within this time Ctrl-C is answered (s).
PROMISED = 0.1
#: A run of a million frames is a second of work at least, where nothing is optimised ten.
SETUP = """
import os, signal, sys, tempfile, time
import numpy as np
import stiction

scene = stiction.Scene.bundled("corner-stick-slip")
hand = scene.hand_array()
long = np.resize(np.concatenate([hand, hand[::-1]]), (FRAMES, 3))
solver = stiction.Solver(scene)
folder = tempfile.mkdtemp()
"""
WORK = {
    "run": ("", "solver.run(long)", 20_000_000),
    "contacts": ("run = solver.run(long)", "run.contacts", 1_000_000),
    "write_trace": ("run = solver.run(long); run.contacts", "run.write_trace(folder + '/trace.jsonl')", 1_000_000),
    "judge": ("run = solver.run(long); run.contacts", "run.judge()", 300_000),
    "figures": ("run = solver.run(long); run.contacts", "run.figures()", 500_000),
    "hand": ("", "scene.hand_array(rate=1e7)", 1),
}
INTERRUPTED = """
print("ready", flush=True)
try:
    WORK
    print("done", time.time())
except KeyboardInterrupt:
    print("stopped", time.time())
print(len(solver), *os.listdir(folder))
"""


def interrupted(name):
    """Interrupts some work after 0.3 s: how it ended, how long after (s), and what is left."""
    before, work, frames = WORK[name]
    script = SETUP.replace("FRAMES", str(frames)) + before + INTERRUPTED.replace("WORK", work)
    child = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True)
    try:
        assert child.stdout.readline() == "ready\n"
        time.sleep(0.3)
        sent = time.time()
        child.send_signal(signal.SIGINT)
        (how, at), left = (line.split() for line in child.stdout.read().splitlines())
    finally:
        child.kill()
        child.wait()
    return how, float(at) - sent, left


@pytest.mark.parametrize("name", WORK)
def test_ctrl_c_is_answered_at_once(name):
    # A machine that is busy may be late, but not each time.
    attempts = []
    while len(attempts) < 5 and not (attempts and attempts[-1][1] <= PROMISED):
        attempts.append(interrupted(name))
        how, _, left = attempts[-1]
        assert how == "stopped"
        # The solver is where it was, and no trace is half-written.
        assert left == (["0"] if name in ("run", "hand") else [str(WORK[name][2])])
    assert attempts[-1][1] <= PROMISED, [late for _, late, _ in attempts]


def test_more_frames_than_memory_are_a_memory_error():
    solver = stiction.Solver(stiction.Scene.bundled("box-flat"))
    # The array takes 24 bytes, its answers would take 600 GB.
    with pytest.raises(MemoryError):
        solver.run(np.broadcast_to([0.0, 0.03, 0.0], (4_000_000_000, 3)))
    assert len(solver) == 0


LITTLE = """
import resource

used = int(open("/proc/self/statm").read().split()[0]) * resource.getpagesize()
def within(room, work):
    resource.setrlimit(resource.RLIMIT_AS, (used + room, resource.RLIM_INFINITY))
    try:
        work()
        return "done"
    except MemoryError:
        return "MemoryError"
    finally:
        resource.setrlimit(resource.RLIMIT_AS, (resource.RLIM_INFINITY, resource.RLIM_INFINITY))
"""


@pytest.mark.skipif(not os.path.exists("/proc/self/statm"), reason="Linux says how much memory a process has")
@pytest.mark.parametrize(
    ("before", "work"),
    [
        ("", "solver.run(long)"),
        ("run = solver.run(long)", "run.contacts"),
        ("run = solver.run(long); run.contacts", "run.figures()"),
        ("", "scene.hand_array(rate=1e6)"),
    ],
)
def test_too_little_memory_is_a_memory_error(before, work):
    script = SETUP.replace("FRAMES", "300_000") + before + LITTLE
    script += f"\nprint(within(8 << 20, lambda: {work}), within(2 << 30, lambda: {work}))"
    outcome = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert outcome.stdout.split() == ["MemoryError", "done"], outcome.stderr
