"""Solvers: frame by frame, or over whole arrays."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _stiction
from ._run import Run
from ._scene import Scene
from ._tables import EVENTS, STATES, STATUSES, Table


#: Samples per second if no times are given (Hz).
RATE = 1000.0


class Frame(NamedTuple):
    """The answer to a sample of the hand."""

    #: x, y (m), theta (rad) of the body, world frame.
    pose: npt.NDArray[np.float64]
    #: Force (N) and moment about the holding point (N m) of the hand on the body.
    wrench: npt.NDArray[np.float64]
    #: One of `STATES`.
    state: str
    #: What limited the answer: "ok", or another of `STATUSES`.
    status: str
    #: The events of the frame, in order, from `EVENTS`.
    events: tuple[str, ...]
    #: Slips that ended in this frame.
    slips: int
    #: A structured array of type `CONTACT`.
    contacts: Table
    #: The fraction of the hand's displacement that is left to follow, 0 to 1; nan without a budget.
    behind: float


class Solver:
    """A solver with its run.

    Args:
        scene: the scene to solve.
        number: "f32"; "f64", the reference; or "fixed", as on chips without a floating-point unit.
        evolution: "path", with exact events along the straight path of the hand, or "frame", cheaper.
        budget: the most work of a frame (units, 1 or more); None: unlimited.

    Raises:
        ValueError: an argument is unusable, or the scene is in this number type.
    """

    scene: Scene
    _solver: _stiction.Solver

    def __init__(
        self, scene: Scene, *, number: str = "f32", evolution: str = "path", budget: int | None = None
    ) -> None:
        self.scene = scene
        self._solver = _stiction.Solver(scene._scene, number=number, evolution=evolution, budget=budget)

    def step(
        self,
        x: float,
        y: float,
        phi: float,
        *,
        held: bool = True,
        depth: float = 0.0,
        t: float | None = None,
    ) -> Frame:
        """One frame: the hand moves to x, y (m), phi (rad), world frame; the first one starts the scene.

        held: whether the hand holds the body. depth: a coordinate that is passed through (m). t: the time (s), which affects nothing;
        None: at 1000 Hz. A hand that is not finite is not an error: the status is "held-last", and the body stays.
        """
        time = len(self) / RATE if t is None else t
        run = Run(self.scene, self._solver.step(x, y, phi, held=held, depth=depth, t=time))
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

    def run(
        self,
        hand: npt.ArrayLike,
        *,
        t: npt.ArrayLike | None = None,
        held: npt.ArrayLike | None = None,
        rate: float = RATE,
    ) -> Run:
        """Runs all rows of an array, from the scene's start.

        hand: (N, 3) x, y (m), phi (rad), world frame; or (N, 7), poses of a tracker: position (m) and quaternion (x, y, z, w), placed as in the
        scene's [hand]. t: times (s); None: by `rate` (Hz). held: whether the hand holds the body; None: always. An array of f64 is
        read in place, and other threads run meanwhile: do not write to it.
        """
        array = np.require(hand, np.float64, ["A"])
        if array.ndim != 2:
            raise ValueError(f"`hand` has {array.ndim} dimensions, allowed: 2, as (N, 3) or (N, 7)")
        times = None if t is None else np.require(t, np.float64, ["A"])
        holds = None if held is None else np.require(held, np.bool_, ["A"])
        for name, given in (("t", times), ("held", holds)):
            if given is not None and given.ndim != 1:
                raise ValueError(f"`{name}` has {given.ndim} dimensions, allowed: 1")
        return Run(self.scene, self._solver.run(array, t=times, held=holds, rate=rate))

    def snapshot(self) -> Solver:
        """A copy that continues independently from here."""
        copy = Solver.__new__(Solver)
        copy.scene = self.scene
        copy._solver = self._solver.snapshot()
        return copy

    __copy__ = snapshot

    def restore(self, snapshot: Solver) -> None:
        """Returns to a snapshot of this solver; one of another solver raises a ValueError."""
        self._solver.restore(snapshot._solver)

    def reset(self) -> None:
        """Returns to the scene's start."""
        self._solver.reset()

    def __len__(self) -> int:
        """The number of frames since the start."""
        return len(self._solver)

    def __bool__(self) -> bool:
        return True

    def __reduce__(self) -> tuple[Any, ...]:
        if len(self) > 0:
            raise ValueError("a solver in the middle of a run cannot be pickled, allowed: one at its start; a Run can")
        settings = {
            "number": self._solver.number,
            "evolution": self._solver.evolution,
            "budget": self._solver.budget,
        }
        return (_solver, (self.scene, settings))

    def __repr__(self) -> str:
        return f"<stiction.Solver {self._solver.number}, {self._solver.evolution}, after {len(self)} frames>"


def _solver(scene: Scene, settings: dict[str, Any]) -> Solver:
    return Solver(scene, **settings)
