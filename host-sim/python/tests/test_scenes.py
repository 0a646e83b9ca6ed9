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
    ],
)
def test_what_cannot_be_used_is_named(changes, part):
    with pytest.raises(ValueError, match=part):
        stiction.Solver(box(**changes))


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
