"""Scenes from values: the same bits as from a scene file, and the same error messages."""

import pickle

import numpy as np
import pytest
import stiction
from hypothesis import given, settings
from hypothesis import strategies as st
from tables import same

BOX = [(-0.05, -0.03), (0.05, -0.03), (0.05, 0.03), (-0.05, 0.03)]
FLOOR = {"normal": (0.0, 1.0), "offset": 0.0, "static": 0.5, "dynamic": 0.3}


def box(**changes):
    values = {
        "vertices": BOX,
        "start": (0.0, 0.03, 0.0),
        "holding_point": (0.0, 0.0),
        "translation": 500.0,
        "rotation": 0.5,
        "surfaces": [FLOOR],
    }
    return stiction.Scene(**{**values, **changes})


def test_values_and_a_file_make_the_same_scene(tmp_path):
    scene = box()
    file = tmp_path / "box.toml"
    file.write_text(scene.text)
    again = stiction.Scene.from_toml(file)
    hand = np.column_stack([np.linspace(0, 0.1, 200), np.full(200, 0.02), np.zeros(200)])
    runs = [stiction.Solver(s).run(hand) for s in (scene, again)]
    same(*runs)


@pytest.mark.parametrize(
    ("changes", "part"),
    [
        ({"translation": -1.0}, "translation"),
        ({"vertices": []}, "vertices"),
        ({"surfaces": [{**FLOOR, "static": 0.1}]}, "static"),
        ({"surfaces": [{**FLOOR, "offset": float("nan")}]}, "offset"),
        ({"start": (0.0, 0.0, 0.0)}, "start"),
        ({"surfaces": [{**FLOOR, "colour": "red"}]}, "colour"),
        ({"surfaces": [{**FLOOR, "name": "a\"b\\c\n"}] * 2}, "name"),
        ({"surfaces": [{**FLOOR, "a = 1\n[body]": 1}]}, "body"),
        ({"vertices": 3}, "vertices"),
        ({"vertices": [(0, 0), (1, object())]}, "object"),
        ({"vertices": BOX[::-1]}, "vertices"),
        ({"vertices": [(0.0, 0.0)] * 3}, "vertices"),
        ({"vertices": np.ma.array(BOX, mask=[[False, False]] * 3 + [[True, False]])}, "masked"),
    ],
)
def test_what_cannot_be_used_is_named(changes, part):
    with pytest.raises(ValueError, match=part):
        box(**changes)


@pytest.mark.parametrize(
    ("call", "part"),
    [
        (lambda s: stiction.Solver(s, number="f16"), "f16"),
        (lambda s: stiction.Solver(s, evolution="leap"), "leap"),
        (lambda s: stiction.Solver(s, budget=0), "budget"),
        (lambda s: stiction.Solver(s).run(np.zeros((4, 5))), "5 columns"),
        (lambda s: stiction.Solver(s).run(np.zeros(4)), "1 dimensions"),
        (lambda s: stiction.Solver(s).run(np.zeros((4, 3)), rate=0.0), "rate"),
        (lambda s: stiction.Solver(s).run(np.zeros((4, 3)), t=np.zeros(3)), "3 elements"),
        (lambda s: stiction.Solver(s).run(np.zeros((4, 3)), held=np.ones((4, 1))), "2 dimensions"),
        (lambda s: stiction.Solver(s).run([["a", "b", "c"]]), "could not convert"),
        (lambda s: stiction.Solver(s).run(np.zeros((4, 3)), t=[0.0, 1.0, np.inf, 3.0]), "`t`, row 2: inf"),
        (lambda s: stiction.Solver(s).run(np.zeros((2, 3)), t=np.ma.array([0.0, 1.0], mask=[0, 1])), "`t`, row 1: NaN"),
        (lambda s: stiction.Solver(s).step(0.0, 0.0, 0.0, t=np.nan), "`t` is NaN"),
        (lambda s: s.hand_array(), "keyframes"),
        (lambda s: s.recorded("nowhere.csv"), "nowhere.csv"),
        (lambda s: stiction.Scene.bundled("box"), "box-flat"),
        (lambda s: stiction.Scene.from_toml("nowhere.toml"), "nowhere.toml"),
    ],
)
def test_arguments_that_cannot_be_used_are_named(call, part):
    with pytest.raises(ValueError, match=part):
        call(box())


def test_a_hand_that_is_not_finite_leaves_the_body_where_it_was():
    solver = stiction.Solver(box())
    before = solver.step(0.0, 0.02, 0.0)
    lost = solver.step(float("nan"), 0.02, 0.0)
    assert lost.status == "held-last"
    assert np.array_equal(before.pose, lost.pose)


def test_a_recorded_hand_is_placed_over_the_scene_when_asked_for(tmp_path):
    path = tmp_path / "mm.csv"
    lines = [f"{0.01 * k},{1000 + k},{700 - k},0" for k in range(100)]
    path.write_text("\n".join(["t,x,y,phi", *lines]))
    with pytest.warns(UserWarning, match="hand.scale = 0.001"):
        box().recorded(path)
    hand = box().recorded(path, fit=True)["hand"]
    assert np.allclose(np.ptp(hand, axis=0), [0.099, 0.099, 0.0])
    assert np.hypot(*hand[0, :2]) < 0.2


def poses(hand):
    """A hand as the poses of a tracker."""
    zero = np.zeros(len(hand))
    return np.column_stack([hand[:, :2], zero, zero, zero, np.sin(hand[:, 2] / 2), np.cos(hand[:, 2] / 2)])


@pytest.mark.parametrize("shape", [lambda hand: hand, poses], ids=["3", "7"])
@pytest.mark.parametrize("first", [0, 500])
def test_masked_rows_are_lost_samples(first, shape):
    hand = shape(np.column_stack([np.linspace(0, 0.1, 1000), np.full(1000, 0.02), np.zeros(1000)]))
    lost = slice(first, first + 400)
    nan = hand.copy()
    nan[lost] = np.nan
    expected = stiction.Solver(box()).run(nan)
    assert {stiction.STATUSES[status] for status in expected.frames["status"][lost]} == {"held-last"}
    # All of a row, one value of it, or whether the hand holds.
    for columns in (slice(None), 0, -1):
        masked = np.ma.array(hand, mask=False)
        masked[lost, columns] = np.ma.masked
        same(stiction.Solver(box()).run(masked), expected)
        assert np.array_equal(masked.data, hand)
    held = np.ma.array(np.ones(1000, bool), mask=False)
    held[lost] = np.ma.masked
    same(stiction.Solver(box()).run(hand, held=held), expected)
    assert (stiction.Solver(box()).run(np.ma.array(hand)).frames["status"] == stiction.STATUSES.index("ok")).all()


def test_a_frame_has_its_values_by_name_and_by_number():
    solver = stiction.Solver(box())
    solver.step(0.0, 0.02, 0.0)
    frame = solver.step(0.02, 0.02, 0.0)
    pose, wrench, state, status, events, slips, contacts, behind = frame
    assert np.array_equal(pose, frame.pose) and np.array_equal(wrench, frame.wrench)
    # Pressed 1 cm deep at 500 N/m, and dragged by 2 cm: four times (5 N 0.5 - 5 N 0.3) / 500 N/m.
    assert (frame.state, frame.status, frame.slips) == (state, status, slips) == ("edge", "ok", 8)
    assert events == frame.events == ("slip",)
    assert contacts.dtype == stiction.CONTACT and contacts["normal"].sum() == pytest.approx(5.0)
    assert np.isnan(behind) and len(frame) == 8 and frame[2] == frame[-6] == state
    with pytest.raises(IndexError):
        frame[8]
    with pytest.raises(ValueError, match="read-only"):
        frame.pose[0] = 1.0
    with pytest.raises(AttributeError):
        frame.slips = 3
    again = pickle.loads(pickle.dumps(frame))
    assert np.array_equal(again.contacts, frame.contacts) and again.events == frame.events
    assert np.array_equal(again.pose, frame.pose) and again.slips == 8


@settings(deadline=None, max_examples=60)
@given(
    hand=st.lists(
        st.tuples(st.floats(-0.2, 0.2), st.floats(-0.1, 0.2), st.floats(-3.0, 3.0)),
        min_size=1,
        max_size=40,
    ),
    number=st.sampled_from(["f32", "f64", "fixed"]),
)
def test_every_hand_gives_lawful_frames(hand, number):
    run = stiction.Solver(box(), number=number).run(np.array(hand))
    report = run.judge()
    assert report.lawful, report.text


def test_scenes_runs_and_fresh_solvers_can_be_pickled():
    scene = box()
    hand = np.column_stack([np.linspace(0, 0.1, 50), np.full(50, 0.02), np.zeros(50)])
    run = stiction.Solver(scene).run(hand)
    again_scene, again_run, again_solver = (
        pickle.loads(pickle.dumps(value)) for value in (scene, run, stiction.Solver(scene))
    )
    assert again_scene == scene
    same(again_run, run)
    same(again_solver.run(hand), run)
    stepped = stiction.Solver(scene)
    stepped.step(0.0, 0.0, 0.0)
    with pytest.raises(ValueError, match="pickled"):
        pickle.dumps(stepped)
