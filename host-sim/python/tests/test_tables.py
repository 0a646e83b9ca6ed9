"""Runs as tables: pandas, Parquet, traces, figures."""

import json

import numpy as np
import pytest
import stiction


@pytest.fixture(params=["corner-stick-slip", "table-edge"])
def run(request):
    scene = stiction.Scene.bundled(request.param)
    return stiction.Solver(scene).run(scene.hand_array(rate=200.0))


def same(one, other):
    """The same tables, where what is not a number is the same as itself."""
    for name in ("frames", "contacts", "events"):
        a, b = getattr(one, name), getattr(other, name)
        assert a.dtype == b.dtype and len(a) == len(b)
        for field in a.dtype.names:
            is_float = a.dtype[field].base.kind == "f"
            assert np.array_equal(a[field], b[field], equal_nan=is_float), field


def test_pandas_and_back(run):
    frames, contacts, events = run.to_pandas()
    assert len(frames) == len(run)
    assert set(frames["state"]) <= set(stiction.STATES)
    same(run, stiction.Run.from_pandas(run.scene, frames, contacts, events))


def test_parquet_and_back(run, tmp_path):
    run.to_parquet(tmp_path / "run")
    same(run, stiction.Run.from_parquet(tmp_path / "run"))


def test_a_trace_is_that_of_the_program(run, tmp_path):
    run.write_trace(tmp_path / "trace.jsonl")
    records = [json.loads(line) for line in (tmp_path / "trace.jsonl").read_text().splitlines()]
    assert len(records) == len(run)
    poses = np.array([record["pose"] for record in records], np.float32)
    assert np.array_equal(poses, run.pose.astype(np.float32))
    with pytest.raises(ValueError, match="jsonl"):
        run.write_trace(tmp_path / "trace.txt")


def test_figures(run):
    figures = run.figures()
    assert {"trajectory", "forces", "motion", "strip"} <= set(figures)
    assert all(svg.startswith("<svg") or "<svg" in svg[:300] for svg in figures.values())
    assert len(run.plot().axes) == 5


def test_the_judge_refuses_what_is_changed(run):
    assert run.judge().lawful
    frames = run.frames.copy()
    frames["wrench"][:, 0] += 1.0
    changed = stiction.Run.from_tables(run.scene, frames, run.contacts, run.events)
    report = changed.judge()
    assert not report.lawful and "wrench" in report.text
