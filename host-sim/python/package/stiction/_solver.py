"""Solvers: frame by frame, or over whole arrays."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from . import _stiction
from ._run import Run
from ._scene import Scene
from ._stiction import Frame
from ._types import Evolution, Number

#: Samples per second if no times are given (Hz).
RATE = 1000.0


class Solver:
    """A solver with its run: `step` and `run` continue it, `reset` returns to its start.

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
        self,
        scene: Scene,
        *,
        number: Number = "f32",
        evolution: Evolution = "path",
        budget: int | None = None,
    ) -> None:
        self.scene = scene
        self._solver = _stiction.Solver(
            scene._scene, number=number, evolution=evolution, budget=budget
        )

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

        held: whether the hand holds the body. depth: a coordinate that is passed through (m). t: the time (s), finite, which affects
        nothing; None: at 1000 Hz. A hand that is not finite is not an error: the status is "held-last", and the body stays.
        """
        return self._solver.step(x, y, phi, held, depth, t)

    def run(
        self,
        hand: npt.ArrayLike,
        *,
        t: npt.ArrayLike | None = None,
        held: npt.ArrayLike | None = None,
        rate: float = RATE,
    ) -> Run:
        """A `step` for every row of an array: it continues where the solver is; `reset` before it returns to the scene's start.

        hand: (N, 3) x, y (m), phi (rad), world frame; or (N, 7), poses of a tracker: position (m) and quaternion (x, y, z, w), placed as in the
        scene's [hand], the angle unwrapped from one to the next. t: times (s), finite, which affect nothing; None: the number of samples so
        far, divided by `rate` (Hz). held: whether the hand holds the body; None: always.

        A row that is not finite, or in which `hand` or `held` is masked, is a lost sample: its status is "held-last", and the body
        stays. An array of f64 without a mask is read in place, and other threads run meanwhile: do not write to it.

        Raises:
            ValueError: an argument is unusable.
            MemoryError: there is too little memory for the answers.
            KeyboardInterrupt: Ctrl-C. After any error, the solver is where it was before.
        """
        array = np.require(hand, np.float64, ["A"])
        if array.ndim != 2:
            raise ValueError(f"`hand` has {array.ndim} dimensions, allowed: 2, as (N, 3) or (N, 7)")
        times = None if t is None else np.require(t, np.float64, ["A"])
        holds = None if held is None else np.require(held, np.bool_, ["A"])
        for name, given in (("t", times), ("held", holds)):
            if given is not None and given.ndim != 1:
                raise ValueError(f"`{name}` has {given.ndim} dimensions, allowed: 1")
        if isinstance(times, np.ma.MaskedArray):
            times = times.filled(np.nan)
        masked = [given for given in (array, holds) if isinstance(given, np.ma.MaskedArray)]
        if masked:
            array = np.array(array)
        for given in masked:
            rows = np.nonzero(np.ma.getmaskarray(given))[0]
            array[rows[rows < len(array)]] = np.nan
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
            raise ValueError(
                "a solver in the middle of a run cannot be pickled, allowed: one at its start; a Run can"
            )
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
