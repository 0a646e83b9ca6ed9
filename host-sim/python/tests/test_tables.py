"""Runs as tables: pandas, Parquet, traces, figures."""

import numpy as np
import pytest
import stiction
from tables import same


@pytest.fixture(params=["corner-stick-slip", "table-edge"])
def run(request):
    scene = stiction.Scene.bundled(request.param)
    return stiction.Solver(scene).run(scene.hand_array(rate=200.0))


def test_tables_cannot_be_written(run):
    for table in (run.frames, run.contacts, run.events):
        with pytest.raises(ValueError, match="read-only"):
            table[0] = table[1]


def test_contacts_and_events_are_of_frames_in_order(run):
    for table in (run.contacts, run.events):
        assert (np.diff(table["frame"].astype(int)) >= 0).all()
    # The hand's springs bear the load of the contacts: the difference is the weight.
    vertical = np.bincount(run.contacts["frame"], minlength=len(run)) > 0
    assert (run.frames["state"][vertical] != stiction.STATES.index("non-contact")).all()
    assert (run.frames["state"][~vertical] == stiction.STATES.index("non-contact")).all()


def test_pandas_and_back(run):
    frames, contacts, events = run.to_pandas()
    assert len(frames) == len(run) and len(contacts) == len(run.contacts)
    assert set(frames["state"]) <= set(stiction.STATES)
    same(run, stiction.Run.from_pandas(run.scene, frames, contacts, events))


def test_a_table_that_is_none_is_refused(run):
    frames, contacts, events = run.to_pandas()
    with pytest.raises(ValueError, match="`wrench_x` is missing"):
        stiction.Run.from_pandas(run.scene, frames.drop(columns="wrench_x"), contacts, events)
    with pytest.raises(ValueError, match="flying"):
        stiction.Run.from_pandas(run.scene, frames.assign(state="flying"), contacts, events)
    with pytest.raises(ValueError, match="`contacts`"):
        stiction.Run.from_tables(run.scene, run.frames[:10], run.contacts, run.events)
    with pytest.raises(ValueError, match="f16"):
        stiction.Run.from_tables(run.scene, run.frames, run.contacts, run.events, "f16")


def test_parquet_and_back(run, tmp_path):
    run.to_parquet(tmp_path / "run")
    again = stiction.Run.from_parquet(tmp_path / "run")
    same(run, again)
    assert again.scene == run.scene


@pytest.mark.parametrize(
    ("text", "part"),
    [
        ("{", "line 1"),
        ("[1, 2]", "line 1"),
        ('{"t": 0.0}', "`contacts`|'contacts'|'hand'"),
    ],
)
def test_what_is_no_trace_is_refused(run, tmp_path, text, part):
    file = tmp_path / "trace.jsonl"
    file.write_text(text)
    with pytest.raises(ValueError, match=part):
        stiction.Run.read_trace(run.scene, file)


def test_a_trace_has_a_known_ending_and_a_folder_that_is_there(run, tmp_path):
    with pytest.raises(ValueError, match="jsonl"):
        run.write_trace(tmp_path / "trace.txt")
    with pytest.raises(OSError, match="trace.csv"):
        run.write_trace(tmp_path / "nowhere" / "trace.csv")
    run.write_trace(tmp_path / "trace.csv")
    assert len((tmp_path / "trace.csv").read_text().splitlines()) == len(run) + 1


def test_figures(run):
    figures = run.figures()
    assert {"trajectory", "forces", "motion", "strip"} <= set(figures)
    assert all("<svg" in svg[:300] for svg in figures.values())


def test_the_judge_refuses_what_is_changed(run):
    assert run.judge().lawful
    frames = run.frames.copy()
    frames["wrench"][:, 0] += 1.0
    changed = stiction.Run.from_tables(run.scene, frames, run.contacts, run.events)
    report = changed.judge()
    assert not report.lawful and "unlawful" in report.text
