"""Runs: the answers of a solver as tables; judged, drawn and exported."""

from __future__ import annotations

import os
from collections.abc import Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _parquet, _stiction, _tables, _trace
from ._scene import Scene
from ._tables import CONTACT, EVENT, EVENTS, FRAME, STATES, STATUSES, Table
from ._types import Evolution, Number, Picture

if TYPE_CHECKING:
    import pandas
    from matplotlib.figure import Figure


class Report(NamedTuple):
    """The judge's findings."""

    #: Frames that break a law.
    unlawful: int
    #: The report as text, as `stiction check` prints it.
    text: str

    @property
    def lawful(self) -> bool:
        """Whether no frame breaks a law."""
        return self.unlawful == 0


class Run:
    """The answers of a solver to a hand, as read-only tables.

    Attributes:
        scene: the scene.
        frames: a structured array of type `FRAME`, one row for each frame.
        events: one of type `EVENT`, one row for each event, in order.
    """

    scene: Scene
    frames: Table
    events: Table
    _run: _stiction.Run

    def __init__(self, scene: Scene, run: _stiction.Run) -> None:
        """Called by `Solver.run` and `Run.from_...`."""
        self.scene = scene
        self._run = run
        self.frames = _tables.read_only(run.frames, FRAME)
        self.events = _tables.read_only(run.events, EVENT)

    @cached_property
    def contacts(self) -> Table:
        """A structured array of type `CONTACT`, one row for each contact of each frame, in the order of frames.

        After `Solver.run`, it is computed on first access by repeating the run, which takes longer than the run itself.
        """
        return _tables.read_only(self._run.contacts, CONTACT)

    @property
    def number(self) -> Number:
        """The number type of the solver: "f32", "f64" or "fixed"."""
        return self._run.number

    @property
    def evolution(self) -> Evolution:
        """The evolution of frames: "path" or "frame"."""
        return self._run.evolution

    @property
    def pose(self) -> npt.NDArray[np.float64]:
        """The poses of the body, (N, 3): x, y (m), theta (rad)."""
        return self.frames["pose"]

    @property
    def wrench(self) -> npt.NDArray[np.float64]:
        """The wrench of the hand's springs on the body, (N, 3): force x, y (N), moment about the holding point (N m)."""
        return self.frames["wrench"]

    def __len__(self) -> int:
        return len(self.frames)

    def __repr__(self) -> str:
        return f"<stiction.Run of {len(self)} frames, {len(self.events)} events>"

    @classmethod
    def from_tables(
        cls,
        scene: Scene,
        frames: Table,
        contacts: Table,
        events: Table,
        number: Number = "f32",
        evolution: Evolution = "path",
    ) -> Run:
        """A run from structured arrays like those of a run, which are copied. Rows that cannot be those of a run raise a ValueError."""
        tables = (frames, FRAME), (contacts, CONTACT), (events, EVENT)
        copies = [_tables.words(table, dtype) for table, dtype in tables]
        return cls(scene, _stiction.Run.of(scene._scene, (number, evolution), *copies))

    def __reduce__(self) -> tuple[Any, ...]:
        tables = (self.frames, self.contacts, self.events)
        return (Run.from_tables, (self.scene, *tables, self.number, self.evolution))

    def judge(self) -> Report:
        """Judges every frame by the laws of statics and friction alone, as `stiction check` does; the hand's path is not compared."""
        return Report(*self._run.judge())

    def write_trace(self, path: str | os.PathLike[str]) -> None:
        """Writes a trace, `.jsonl` or `.csv`, identical byte for byte to that of `stiction run --out`."""
        self._run.write_trace(path)

    @classmethod
    def read_trace(
        cls,
        scene: Scene,
        path: str | os.PathLike[str],
        number: Number = "f32",
        evolution: Evolution = "path",
    ) -> Run:
        """A run from a trace of `stiction run --out`, `.jsonl`, of this scene. Traces do not contain `longest_slip`: it is nan."""
        return cls.from_tables(scene, *_trace.tables(scene, path, number), number, evolution)

    def figures(self) -> dict[str, str]:
        """The pictures of `stiction run --plot` by name, as SVG."""
        return dict(self._run.figures())

    def plot(self) -> Figure:
        """A figure of matplotlib: paths in the plane, forces, motion, and a strip of snapshots. A notebook shows it as a picture."""
        from . import _plot

        return _plot.overview(self)

    def figure(
        self,
        picture: Picture = "forces",
        *,
        width: float = 85.0,
        at: float | Sequence[float] | None = None,
        between: tuple[float, float] | None = None,
        title: str | None = None,
    ) -> npt.NDArray[Any]:
        """One picture for a paper: the axes of matplotlib, to change, in an array from top to bottom or from left to right.

        picture: "trajectory", the paths in the plane; "forces" or "motion" over time; "strip", snapshots. width: of the figure (mm), 20 to
        2000; the text is 7 and 8 pt high, whatever the width. at: instants (s) to pick out: the bodies of a trajectory, the snapshots of a
        strip, lines over time; None: the start and the end, or six that differ. between: first and last time (s) of the part that is shown;
        None: all. title: above the picture; None: none. An unusable argument raises a ValueError.

        Example:
            axes = run.figure("forces", width=85, between=(0.1, 0.4))
            axes[0].set_ylim(-3, 6)
            axes[0].figure.savefig("forces.pdf")
        """
        from . import _plot

        return _plot.figure(self, picture, width, at, between, title)

    def to_pandas(self) -> tuple[pandas.DataFrame, pandas.DataFrame, pandas.DataFrame]:
        """Three data frames: frames, contacts, events; units as in `FRAME` and `CONTACT`, names instead of the numbers of states."""
        import pandas

        frames = pandas.DataFrame(_tables.columns(self.frames))
        frames["state"] = _tables.named(self.frames["state"], STATES)
        frames["status"] = _tables.named(self.frames["status"], STATUSES)
        contacts = pandas.DataFrame(_tables.columns(self.contacts))
        events = pandas.DataFrame(_tables.columns(self.events))
        events["event"] = _tables.named(self.events["event"], EVENTS)
        return frames, contacts, events

    @classmethod
    def from_pandas(
        cls,
        scene: Scene,
        frames: pandas.DataFrame,
        contacts: pandas.DataFrame,
        events: pandas.DataFrame,
        number: Number = "f32",
        evolution: Evolution = "path",
    ) -> Run:
        """The inverse of `to_pandas`. A missing column or an unknown name raises a ValueError."""
        taken: list[dict[str, Any]] = [dict(given.items()) for given in (frames, contacts, events)]  # type: ignore[arg-type]
        coded = (taken[0], "state", STATES), (taken[0], "status", STATUSES), (taken[2], "event", EVENTS)
        for columns, name, known in coded:
            if name in columns:
                columns[name] = _tables.numbers(name, known, columns[name])
        made = [
            _tables.table(dtype, columns, len(given))
            for dtype, columns, given in zip(
                (FRAME, CONTACT, EVENT), taken, (frames, contacts, events)
            )
        ]
        return cls.from_tables(scene, made[0], made[1], made[2], number, evolution)

    def to_parquet(self, folder: str | os.PathLike[str]) -> None:
        """Writes `frames.parquet`, `contacts.parquet` and `events.parquet`, as from `to_pandas`, into a folder; the scene is in their metadata."""
        about = {"scene": self.scene.text, "number": self.number, "evolution": self.evolution}
        _parquet.write(folder, self.to_pandas(), about)

    @classmethod
    def from_parquet(cls, folder: str | os.PathLike[str]) -> Run:
        """The inverse of `to_parquet`."""
        tables, about = _parquet.read(folder)
        scene = Scene.from_text(about["scene"])
        return cls.from_pandas(scene, *tables, about["number"], about["evolution"])
