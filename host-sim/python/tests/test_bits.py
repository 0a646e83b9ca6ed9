"""The package has the bits of the program, in every number type and evolution, among obstacles and without."""

import numpy as np
import pytest
import stiction

SCENES = ["box-flat", "corner-stick-slip", "vertex-stick-slip", "rod-on-floor", "table-edge", "peg-in-hole"]


@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.parametrize("number", ["f32", "f64", "fixed"])
@pytest.mark.parametrize("evolution", ["path", "frame"])
def test_run_has_the_bits_of_the_program(stiction_run, scene, number, evolution):
    records = stiction_run(scene, "--number", number, "--evolution", evolution)
    described = stiction.Scene.bundled(scene)
    run = stiction.Solver(described, number=number, evolution=evolution).run(described.hand_array())
    assert len(run) == len(records)
    # What is printed with the digits of f32 reads back to an f32.
    kind = np.float64 if number == "f64" else np.float32
    for name in ("pose", "wrench"):
        printed = np.array([record[name] for record in records], kind)
        assert np.array_equal(run.frames[name].astype(kind), printed), name
    assert [stiction.STATES[state] for state in run.frames["state"]] == [r["state"] for r in records]
    assert [stiction.STATUSES[s] for s in run.frames["status"]] == [r["status"] for r in records]
    assert run.frames["slips"].tolist() == [record["slips"] for record in records]
    told = [(i, event) for i, record in enumerate(records) for event in record["events"]]
    assert [(int(i), stiction.EVENTS[event]) for i, event in run.events] == told
    forces = [c["normal"] for record in records for c in record["contacts"]]
    assert np.array_equal(run.contacts["normal"].astype(kind), np.array(forces, kind))


@pytest.mark.parametrize("scene", ["corner-stick-slip", "table-edge"])
def test_steps_are_those_of_run(scene):
    described = stiction.Scene.bundled(scene)
    hand = described.hand_array(rate=200.0)
    run = stiction.Solver(described).run(hand)
    solver = stiction.Solver(described)
    for i, row in enumerate(hand):
        frame = solver.step(*row)
        assert np.array_equal(frame.pose, run.frames["pose"][i])
        assert np.array_equal(frame.wrench, run.frames["wrench"][i])
        assert frame.state == stiction.STATES[run.frames["state"][i]]


def test_a_snapshot_goes_on_by_itself_and_can_be_gone_back_to():
    described = stiction.Scene.bundled("corner-stick-slip")
    hand = described.hand_array(rate=200.0)
    solver = stiction.Solver(described)
    for row in hand[:300]:
        solver.step(*row)
    kept = solver.snapshot()
    first = [solver.step(*row).pose for row in hand[300:]]
    copied = kept.snapshot()
    second = [copied.step(*row).pose for row in hand[300:]]
    solver.restore(kept)
    third = [solver.step(*row).pose for row in hand[300:]]
    assert np.array_equal(first, second) and np.array_equal(first, third)
