"""Contact of an object held in the hand, with true stick-slip, by statics alone.

SI units; the world frame is right-handed with y upwards, angles are in radians, counter-clockwise; forces are those on the body.

>>> import stiction
>>> scene = stiction.Scene.bundled("box-flat")
>>> run = stiction.Solver(scene).run(scene.hand_array())
>>> run.judge().lawful
True
"""

from __future__ import annotations

import json
from typing import NamedTuple

import numpy as np

from . import _plot, _tables, _toml
from ._stiction import EVENTS, STATES, STATUSES, __version__
from ._stiction import Run as _Run
from ._stiction import Scene as _Scene
from ._stiction import Solver as _Solver

__all__ = ["EVENTS", "STATES", "STATUSES", "Frame", "Report", "Run", "Scene", "Solver", "__version__"]


class Scene:
    """A body, the springs that hold it, and what it may touch. It does not change.

    vertices: of the body (m), counter-clockwise, in its own frame: one is a point, two a rod. translation, rotation: stiffness of the
    springs (N/m, N m/rad). start: x, y (m), theta (rad). weight (N). holding_point: where the hand holds the body (m, body frame); None:
    where it takes hold. reach: how far outside a hand may be and still take hold (m). surfaces: dictionaries with `normal`, `offset` (m),
    `static`, `dynamic` (friction), and, if you like, `name` and `memory` (m). obstacles: the same with `vertices` (m) instead of normal and
    offset. What cannot be used is a ValueError.
    """

    def __init__(
        self,
        *,
        vertices,
        translation,
        rotation=0.0,
        start=(0.0, 0.0, 0.0),
        weight=None,
        holding_point=None,
        reach=None,
        surfaces=(),
        obstacles=(),
    ):
        text = _toml.scene(
            vertices, start, weight, holding_point, reach, translation, rotation, surfaces, obstacles
        )
        self._scene = _Scene.from_text(text, "scene")

    @classmethod
    def _of(cls, scene):
        made = cls.__new__(cls)
        made._scene = scene
        return made

    @classmethod
    def from_toml(cls, path):
        """A scene file."""
        return cls._of(_Scene.from_toml(path))

    @classmethod
    def from_text(cls, text, name="scene.toml"):
        """The text of a scene file; `name` is that of the file in messages."""
        return cls._of(_Scene.from_text(text, name))

    @classmethod
    def bundled(cls, name):
        """A scene that comes with stiction, as "box-flat"."""
        return cls._of(_Scene.bundled(name))

    @property
    def text(self):
        """The text of its file."""
        return self._scene.text

    @property
    def vertices(self):
        """Of the body (m), body frame: (N, 2)."""
        return np.asarray(self._scene.vertices)

    @property
    def surfaces(self):
        """Name, unit normal and offset (m) of each."""
        return self._scene.surfaces

    @property
    def obstacles(self):
        """Name and corners (m) of each."""
        return self._scene.obstacles

    @property
    def stiffness(self):
        """Of the springs: k_h (N/m), k_theta (N m/rad)."""
        return tuple(self._scene.stiffness)

    def hand_array(self, rate=None):
        """The hand's path of the scene file, at a rate (Hz) or its own: (N, 3) x, y (m), phi (rad)."""
        return np.asarray(self._scene.hand(rate))[:, 1:4]

    def __reduce__(self):
        return (Scene.from_text, (self.text, self._scene.name))

    def __eq__(self, other):
        return isinstance(other, Scene) and self.text == other.text

    def __hash__(self):
        return hash(self.text)

    def __repr__(self):
        return repr(self._scene)


class Frame(NamedTuple):
    """The answer to a sample of the hand."""

    #: x, y (m), theta (rad) of the body.
    pose: np.ndarray
    #: Force (N) and moment about the holding point (N m) of the hand on the body.
    wrench: np.ndarray
    #: "non-contact", "single-vertex", "edge", "two-vertex", "corner" or "locked".
    state: str
    #: What limited the answer: "ok", or why not.
    status: str
    #: What happened, in order.
    events: tuple
    #: Slips that ended.
    slips: int
    #: A structured array, as `Run.contacts`.
    contacts: np.ndarray
    #: The part of the hand's displacement that is left to follow; nan without a budget.
    behind: float


class Report(NamedTuple):
    """What the judge found."""

    #: Frames that break a law.
    unlawful: int
    #: The report as text.
    text: str

    @property
    def lawful(self):
        """No frame breaks a law."""
        return self.unlawful == 0


class Run:
    """What a solver gave.

    frames: a structured array with t, hand, pose, depth, wrench, longest_slip, behind, slips, held, state and status, of which the last two
    are numbers of `STATES` and `STATUSES`. contacts: one row for each contact of each frame. events: one row for each event, numbers of
    `EVENTS`.
    """

    def __init__(self, scene, run):
        self.scene = scene
        self._run = run
        self.frames = run._frames.view(_tables.FRAME)
        self.contacts = run._contacts.view(_tables.CONTACT)
        self.events = run._events.view(_tables.EVENT)

    @property
    def number(self):
        """The number type of the solver."""
        return self._run.number

    @property
    def evolution(self):
        """How frames were evolved."""
        return self._run.evolution

    @property
    def pose(self):
        """Of the body, (N, 3)."""
        return self.frames["pose"]

    @property
    def wrench(self):
        """Of the hand on the body, (N, 3)."""
        return self.frames["wrench"]

    def __len__(self):
        return len(self.frames)

    def __repr__(self):
        return f"<stiction.Run of {len(self)} frames, {len(self.contacts)} contacts, {len(self.events)} events>"

    @classmethod
    def from_tables(cls, scene, frames, contacts, events, number="f32", evolution="path"):
        """Of structured arrays as a run has them."""
        parts = [
            _tables.as_bytes(np.asarray(table, dtype))
            for table, dtype in (
                (frames, _tables.FRAME),
                (contacts, _tables.CONTACT),
                (events, _tables.EVENT),
            )
        ]
        return cls(scene, _Run._of(scene._scene, (number, evolution), *parts))

    def __reduce__(self):
        tables = (self.frames, self.contacts, self.events)
        return (Run.from_tables, (self.scene, *tables, self.number, self.evolution))

    def judge(self):
        """Judges every frame by the laws of statics and friction alone."""
        return Report(*self._run._judge())

    def write_trace(self, path):
        """Writes a trace, `.jsonl` or `.csv`, as `stiction run --out` does."""
        self._run.write_trace(path)

    def figures(self):
        """The pictures of `stiction run --plot`: SVG by name."""
        return dict(self._run.figures())

    def plot(self):
        """A figure of matplotlib: the paths, the forces, the motion."""
        return _plot.figure(self)

    def to_pandas(self):
        """Three data frames: frames, contacts, events; names instead of numbers."""
        import pandas

        frames = pandas.DataFrame(_tables.columns(self.frames))
        frames["state"] = pandas.Categorical.from_codes(self.frames["state"], STATES)
        frames["status"] = pandas.Categorical.from_codes(self.frames["status"], STATUSES)
        contacts = pandas.DataFrame(_tables.columns(self.contacts))
        events = pandas.DataFrame(_tables.columns(self.events))
        events["event"] = pandas.Categorical.from_codes(self.events["event"], EVENTS)
        return frames, contacts, events

    @classmethod
    def from_pandas(cls, scene, frames, contacts, events, number="f32", evolution="path"):
        """The reverse of `to_pandas`."""
        frames = frames.assign(
            state=[STATES.index(name) for name in frames["state"]],
            status=[STATUSES.index(name) for name in frames["status"]],
        )
        events = events.assign(event=[EVENTS.index(name) for name in events["event"]])
        tables = [
            _tables.table(dtype, given, len(given))
            for dtype, given in (
                (_tables.FRAME, frames),
                (_tables.CONTACT, contacts),
                (_tables.EVENT, events),
            )
        ]
        return cls.from_tables(scene, *tables, number, evolution)

    def to_parquet(self, folder):
        """Writes `frames.parquet`, `contacts.parquet` and `events.parquet` into a folder, with the scene in their metadata."""
        import os

        import pyarrow
        import pyarrow.parquet

        os.makedirs(folder, exist_ok=True)
        about = {"scene": self.scene.text, "number": self.number, "evolution": self.evolution}
        for name, frame in zip(("frames", "contacts", "events"), self.to_pandas()):
            table = pyarrow.Table.from_pandas(frame, preserve_index=False)
            metadata = {**(table.schema.metadata or {}), b"stiction": json.dumps(about).encode()}
            path = os.path.join(folder, f"{name}.parquet")
            pyarrow.parquet.write_table(table.replace_schema_metadata(metadata), path)

    @classmethod
    def from_parquet(cls, folder):
        """The reverse of `to_parquet`."""
        import os

        import pyarrow.parquet

        tables = [
            pyarrow.parquet.read_table(os.path.join(folder, f"{name}.parquet"))
            for name in ("frames", "contacts", "events")
        ]
        about = json.loads(tables[0].schema.metadata[b"stiction"])
        frames = [table.to_pandas() for table in tables]
        scene = Scene.from_text(about["scene"])
        return cls.from_pandas(scene, *frames, about["number"], about["evolution"])


class Solver:
    """A solver with its run.

    number: "f32", "f64" or "fixed". evolution: "path", with exact events along the straight path of the hand, or "frame", cheaper. budget:
    the most work of a frame (units); None: as much as it takes.
    """

    def __init__(self, scene, *, number="f32", evolution="path", budget=None):
        self.scene = scene
        self._solver = _Solver(scene._scene, number=number, evolution=evolution, budget=budget)

    def step(self, x, y, phi, *, held=True, depth=0.0, t=None):
        """One frame: the hand goes to x, y (m), phi (rad)."""
        run = Run(self.scene, self._solver.step(x, y, phi, held=held, depth=depth, t=t))
        row = run.frames[0]
        return Frame(
            pose=row["pose"],
            wrench=row["wrench"],
            state=STATES[row["state"]],
            status=STATUSES[row["status"]],
            events=tuple(EVENTS[event] for event in run.events["event"]),
            slips=int(row["slips"]),
            contacts=run.contacts,
            behind=float(row["behind"]),
        )

    def run(self, hand, *, t=None, held=None, rate=1000.0):
        """All rows of an array, from the scene's start.

        hand: (N, 3) x, y (m), phi (rad); or (N, 7), poses of a tracker: position (m) and quaternion (x, y, z, w), placed as the scene's
        [hand] says. t: times (s), without them by `rate` (Hz). held: whether the hand holds. An array of f64 is not copied, and other threads
        run meanwhile.
        """
        hand = np.asarray(hand, np.float64)
        if hand.ndim != 2:
            raise ValueError(f"`hand` has {hand.ndim} dimensions, allowed: 2, as (N, 3) or (N, 7)")
        t = None if t is None else np.asarray(t, np.float64)
        held = None if held is None else np.asarray(held, np.bool_)
        return Run(self.scene, self._solver.run(hand, t=t, held=held, rate=rate))

    def snapshot(self):
        """A copy that goes on from here by itself."""
        copy = Solver.__new__(Solver)
        copy.scene = self.scene
        copy._solver = self._solver.snapshot()
        return copy

    __copy__ = snapshot

    def restore(self, snapshot):
        """Back to a snapshot."""
        self._solver.restore(snapshot._solver)

    def reset(self):
        """Back to the scene's start."""
        self._solver.reset()

    def __len__(self):
        return len(self._solver)

    def __reduce__(self):
        if len(self) > 0:
            raise ValueError("a solver in a run cannot be pickled, allowed: one at its start; a Run can")
        settings = {
            "number": self._solver.number,
            "evolution": self._solver.evolution,
            "budget": self._solver.budget,
        }
        return (_solver, (self.scene, settings))

    def __repr__(self):
        return f"<stiction.Solver {self._solver.number}, {self._solver.evolution}, after {len(self)} frames>"


def _solver(scene, settings):
    return Solver(scene, **settings)
