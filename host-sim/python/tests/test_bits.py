"""The package returns the bits of the program: identical traces, in every number type and evolution, with and without obstacles."""

import copy
import pathlib
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
import stiction
from hypothesis import given, settings
from hypothesis import strategies as st
from tables import same

SCENES = [
    "box-flat",
    "corner-stick-slip",
    "ladder",
    "plank-on-posts",
    "peg-in-hole",
    "point-stick-slip",
    "rod-on-floor",
    "slide",
    "table-edge",
    "vertex-stick-slip",
]
# Enough for 100 000 frames over all scenes in a number type and an evolution.
RATE = 2000.0
FRAMES = {}


@pytest.mark.parametrize("evolution", ["path", "frame"])
@pytest.mark.parametrize("number", ["f32", "f64", "fixed"])
@pytest.mark.parametrize("name", SCENES)
def test_a_run_has_the_bytes_of_the_program(stiction_run, tmp_path, name, number, evolution):
    trace = stiction_run(name, "--rate", str(RATE), "--number", number, "--evolution", evolution)
    scene = stiction.Scene.bundled(name)
    run = stiction.Solver(scene, number=number, evolution=evolution).run(**scene.recorded(rate=RATE))
    run.write_trace(tmp_path / "trace.jsonl")
    assert (tmp_path / "trace.jsonl").read_bytes() == trace.read_bytes()
    FRAMES[name, number, evolution] = len(run)


def test_these_were_100_000_frames_of_each():
    if len(FRAMES) < 6 * len(SCENES):
        pytest.skip("not all scenes were run")
    for number in ("f32", "f64", "fixed"):
        assert sum(FRAMES[name, number, "path"] for name in SCENES) >= 100_000


@pytest.mark.parametrize("number", ["f32", "f64", "fixed"])
@pytest.mark.parametrize("name", ["corner-stick-slip", "table-edge"])
def test_a_trace_of_the_program_reads_back_to_the_bits_of_the_run(stiction_run, name, number):
    trace = stiction_run(name, "--number", number)
    scene = stiction.Scene.bundled(name)
    run = stiction.Solver(scene, number=number).run(**scene.recorded())
    # A trace has the direction of a contact with an obstacle alone: a surface has its own.
    missing = ["longest_slip"] if scene.obstacles else ["longest_slip", "direction"]
    same(run, stiction.Run.read_trace(scene, trace, number), without=missing)


def recorded(folder, hand):
    """A file of a recorded hand, with the times of `Solver.run`."""
    file = pathlib.Path(folder) / "hand.csv"
    header = "t,x,y,phi" if hand.shape[1] == 3 else "t,x,y,z,qx,qy,qz,qw"
    rows = np.column_stack([np.arange(len(hand)) / 1000.0, hand])
    file.write_text("\n".join([header, *(",".join(map(repr, row)) for row in rows.tolist())]))
    return file


numbers = st.sampled_from(["f32", "f64", "fixed"])


@settings(deadline=None, max_examples=40)
@given(
    hand=st.lists(
        st.tuples(st.floats(-0.2, 0.2), st.floats(-0.1, 0.2), st.floats(-3.0, 3.0)), min_size=1, max_size=40
    ),
    number=numbers,
    name=st.sampled_from(SCENES),
)
def test_any_hand_has_the_bytes_of_the_program(stiction_run, tmp_path_factory, hand, number, name):
    folder = tmp_path_factory.mktemp("hand")
    scene = stiction.Scene.bundled(name)
    # A recorded hand is placed in the scene by adding the scene's origin, after which there is no
    # -0.
    array = np.array(hand) + 0.0
    trace = stiction_run(name, "--hand", recorded(folder, array), "--number", number)
    stiction.Solver(scene, number=number).run(array).write_trace(folder / "trace.jsonl")
    assert (folder / "trace.jsonl").read_bytes() == trace.read_bytes()


def tracker(count):
    """Poses of a tracker that drag, lift and tilt, the quaternions of any length."""
    s = np.linspace(0.0, 6.0, count)
    turned, tilted = 0.3 * np.sin(s), 0.2 * np.cos(2.0 * s)
    quaternion = np.column_stack([np.sin(tilted), 0.1 * np.sin(s), np.sin(turned), np.cos(turned)])
    return np.column_stack([0.02 * s, 0.06 + 0.03 * np.cos(3.0 * s), 0.01 * s, quaternion])


@pytest.mark.parametrize("name", ["vertex-stick-slip", "table-edge"])
def test_a_tracker_has_the_bytes_of_the_program(stiction_run, tmp_path, name):
    poses = tracker(3000)
    trace = stiction_run(name, "--hand", recorded(tmp_path, poses))
    stiction.Solver(stiction.Scene.bundled(name)).run(poses).write_trace(tmp_path / "trace.jsonl")
    assert (tmp_path / "trace.jsonl").read_bytes() == trace.read_bytes()


@pytest.mark.parametrize("count", [0, 1, 2, 1500])
def test_steps_are_those_of_run_whatever_its_length(count):
    scene = stiction.Scene.bundled("corner-stick-slip")
    hand = scene.hand_array()[1000 : 1000 + count]
    solver, stepped = stiction.Solver(scene), stiction.Solver(scene)
    run = solver.run(hand)
    assert len(run) == len(solver) == count
    for i, row in enumerate(hand):
        frame = stepped.step(*row)
        assert np.array_equal(frame.pose, run.pose[i])
        assert np.array_equal(frame.wrench, run.wrench[i])
        assert frame.state == stiction.STATES[run.frames["state"][i]]
        of_frame = run.contacts[run.contacts["frame"] == i]
        assert np.array_equal(frame.contacts["normal"], of_frame["normal"])
    if count > 0:
        last = hand[-1] + [0.001, 0.0, 0.0]
        assert np.array_equal(solver.step(*last).pose, stepped.step(*last).pose)


@pytest.mark.parametrize("columns", [3, 7])
def test_a_run_continues_where_the_solver_is(columns):
    scene = stiction.Scene.bundled("corner-stick-slip")
    hand = scene.hand_array()
    if columns == 7:
        # Three turns, so that the angle has to be unwrapped across the runs.
        half = 0.5 * (hand[:, 2] + np.linspace(0.0, 6.0 * np.pi, len(hand)))
        zero = np.zeros(len(hand))
        hand = np.column_stack([hand[:, :2], zero, zero, zero, np.sin(half), np.cos(half)])
    whole = stiction.Solver(scene).run(hand)
    solver = stiction.Solver(scene)
    stored = solver.snapshot()
    for start in (stored.restore, solver.restore):
        parts = [solver.run(rows) for rows in np.array_split(hand, 7)]
        for name in ("frames", "events"):
            tables = [getattr(part, name) for part in parts]
            of_frame = 0
            for table, part in zip(tables, parts):
                expected = getattr(whole, name)
                if name == "events":
                    expected = expected[(expected["frame"] >= of_frame) & (expected["frame"] < of_frame + len(part))]
                    assert np.array_equal(table["event"], expected["event"])
                else:
                    expected = expected[of_frame : of_frame + len(part)]
                    assert table.tobytes() == expected.tobytes()
                of_frame += len(part)
        assert len(solver) == len(hand)
        solver.restore(stored)
    solver.run(hand[:10])
    solver.reset()
    same(solver.run(hand), whole)


def test_a_refused_run_changes_nothing():
    scene = stiction.Scene.bundled("corner-stick-slip")
    hand = scene.hand_array()
    solver, other = stiction.Solver(scene), stiction.Solver(scene)
    for one in (solver, other):
        one.run(hand[:500])
    for refused in ({"hand": np.zeros((4, 5))}, {"hand": hand, "t": [0.0]}, {"hand": hand, "rate": -1.0}):
        with pytest.raises(ValueError):
            solver.run(**refused)
    same(solver.run(hand[500:]), other.run(hand[500:]))


def test_contacts_are_those_of_the_run_whenever_they_are_asked_for():
    scene = stiction.Scene.bundled("corner-stick-slip")
    hand = scene.hand_array()
    solver = stiction.Solver(scene)
    at_once = solver.run(hand)
    solver.reset()
    later = solver.run(hand)
    contacts = at_once.contacts
    solver.step(*(hand[-1] + [0.001, 0.0, 0.0]))
    hand += 1.0
    with ThreadPoolExecutor(4) as threads:
        for asked in threads.map(lambda _: later.contacts, range(4)):
            assert asked.tobytes() == contacts.tobytes()


def test_an_array_is_read_wherever_its_numbers_are():
    scene = stiction.Scene.bundled("vertex-stick-slip")
    hand = scene.hand_array()
    run = stiction.Solver(scene).run(hand)
    wide = np.zeros((len(hand), 8))
    wide[:, 1:7:2] = hand
    reversed_twice = hand[::-1].copy()[::-1]
    same(run, stiction.Solver(scene).run(wide[:, 1:7:2]))
    same(run, stiction.Solver(scene).run(np.asfortranarray(hand)))
    same(run, stiction.Solver(scene).run(reversed_twice))
    same(run, stiction.Solver(scene).run(hand.astype(">f8")))
    same(run, stiction.Solver(scene).run(hand.tolist()))


def test_a_budget_leaves_a_part_of_the_way():
    scene = stiction.Scene.bundled("vertex-stick-slip")
    bounded = stiction.Solver(scene, budget=1).run(scene.hand_array())
    assert bounded.frames["behind"].max() > 0.0
    assert "behind" in {stiction.STATUSES[status] for status in bounded.frames["status"]}
    assert np.isnan(stiction.Solver(scene).run(scene.hand_array()).frames["behind"]).all()


def test_a_snapshot_goes_on_by_itself_and_can_be_gone_back_to():
    scene = stiction.Scene.bundled("corner-stick-slip")
    hand = scene.hand_array(rate=200.0)
    solver = stiction.Solver(scene)
    for row in hand[:300]:
        solver.step(*row)
    stored = solver.snapshot()
    first = [solver.step(*row).pose for row in hand[300:]]
    copied = copy.copy(stored)
    second = [copied.step(*row).pose for row in hand[300:]]
    solver.restore(stored)
    assert len(solver) == len(stored) == 300
    third = [solver.step(*row).pose for row in hand[300:]]
    assert np.array_equal(first, second) and np.array_equal(first, third)
    with pytest.raises(ValueError, match="snapshot"):
        stiction.Solver(scene, number="f64").restore(stored)
