"""The time of `Solver.run` for a hand of a million frames, compared with the solver alone: speed.py PROGRAM [REPEATS]

PROGRAM is a release build of `stiction`. The hand repeats that of a bundled scene; the time of the solver is the one that `stiction run`
reports: it is measured around the solver's steps, without reading samples, recording answers and writing. Both times are the best of
several alternating runs. "contacts" is the time to compute the contacts of the run on demand, "step" that of `Solver.step`, a sample at a
time, without its answers being asked for.
"""

import re
import subprocess
import sys
import tempfile
import time

import numpy as np
import stiction

SCENES = ["locked", "box-flat", "vertex-stick-slip", "corner-stick-slip", "slide", "table-edge", "peg-in-hole"]
FRAMES = 1_000_000


def hand(scene):
    """The scene's hand, forwards and backwards, so that it does not jump."""
    once = scene.hand_array(rate=1000.0)
    there_and_back = np.concatenate([once, once[::-1]])
    return np.resize(there_and_back, (FRAMES, 3))


def solver_time(program, name, file, number):
    """The time of the solver alone (ns per frame), from the program's summary."""
    arguments = [program, "run", name, "--hand", file, "--number", number]
    summary = subprocess.run(arguments, check=True, capture_output=True, text=True).stdout
    return float(re.search(r"mean time\s+([\d.]+) ns", summary).group(1))


def stepped(solver, array):
    step = solver.step
    for x, y, phi in array.tolist():
        step(x, y, phi)


def timed(work):
    """The result of a task, and its time (ns per frame)."""
    begun = time.perf_counter()
    done = work()
    return done, (time.perf_counter() - begun) / FRAMES * 1e9


def main():
    program, repeats = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 5
    print("| scene | number | solver (ns) | `Solver.run` (ns) | ratio | contacts (ns) | step (ns) |")
    print("|---|---|---:|---:|---:|---:|---:|")
    for name in SCENES:
        scene = stiction.Scene.bundled(name)
        array = hand(scene)
        with tempfile.NamedTemporaryFile("w", suffix=".csv") as file:
            file.write("t,x,y,phi\n")
            np.savetxt(file, np.column_stack([np.arange(FRAMES) / 1000.0, array]), "%.17g", ",")
            file.flush()
            for number in ("f32", "f64"):
                alone, whole, contacts, steps = [], [], [], []
                solver = stiction.Solver(scene, number=number)
                for _ in range(repeats):
                    alone.append(solver_time(program, name, file.name, number))
                    solver.reset()
                    run, taken = timed(lambda: solver.run(array))
                    whole.append(taken)
                    contacts.append(timed(lambda: run.contacts)[1])
                    del run
                    solver.reset()
                    steps.append(timed(lambda: stepped(solver, array))[1])
                row = f"| {name} | {number} | {min(alone):.0f} | {min(whole):.0f} | {min(whole) / min(alone):.2f} |"
                print(f"{row} {min(contacts):.0f} | {min(steps):.0f} |", flush=True)


main()
