"""What of a run is drawn."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from ._tables import Table

if TYPE_CHECKING:
    from ._run import Run

Floats = npt.NDArray[np.float64]


class Part:
    """The frames of a run that are shown, with their contacts, and the instants that are picked out."""

    def __init__(
        self, run: Run, between: tuple[float, float] | None, at: float | Sequence[float] | None
    ) -> None:
        t = run.frames["t"]
        if (between is not None or at is not None) and (np.diff(t) < 0.0).any():
            raise ValueError("the times of the run decrease: `at` and `between` are allowed where they increase")
        first, last = 0, len(t)
        if between is not None:
            begin, end = between
            first, last = int(np.searchsorted(t, begin, "left")), int(np.searchsorted(t, end, "right"))
        if first >= last:
            if len(t) == 0:
                raise ValueError("the run has no frames to draw")
            raise ValueError(f"`between` is {between}: no frames, allowed: times from {t[0]:g} to {t[-1]:g} s")
        self.scene = run.scene._scene
        self.frames = run.frames[first:last]
        of = slice(*np.searchsorted(run.contacts["frame"], (first, last)))
        self.contacts = run.contacts[of]
        self.index = self.contacts["frame"].astype(np.intp) - first
        self.t: Floats = self.frames["t"]
        self.at = None if at is None else [self._frame(time) for time in np.atleast_1d(at)]
        if self.at == []:
            raise ValueError("`at` is empty, allowed: one time or more")

    def _frame(self, time: float) -> int:
        """The frame at a time (s): the last one that is not after it."""
        if not self.t[0] <= time <= self.t[-1]:
            raise ValueError(f"`at` is {time:g}, allowed: times from {self.t[0]:g} to {self.t[-1]:g} s")
        return int(np.searchsorted(self.t, time, "right")) - 1

    @property
    def held(self) -> npt.NDArray[np.bool_]:
        """Whether the hand holds the body, for each frame."""
        return self.frames["held"]

    def holding_points(self) -> Floats:
        """The points where the hand holds the body (m), nan while it does not: hand - force / k_h."""
        points = self.frames["hand"][:, :2] - self.frames["wrench"][:, :2] / self.scene.stiffness[0]
        return np.where(self.held[:, None], points, np.nan)

    def hand_angles(self) -> Floats:
        """The angles of the hand (rad), while it holds the body less their offset in the grip."""
        stiffness = self.scene.stiffness[1]
        if stiffness == 0.0:
            return self.frames["hand"][:, 2]
        held = self.frames["pose"][:, 2] + self.frames["wrench"][:, 2] / stiffness
        return np.where(self.held, held, self.frames["hand"][:, 2])

    def body(self, frame: int) -> Floats:
        """The corners of the body in a frame (m)."""
        x, y, theta = self.frames["pose"][frame].tolist()
        return np.asarray(self.scene.placed((x, y, theta)))

    def of_frame(self, frame: int) -> Table:
        """The contacts of a frame."""
        return self.contacts[slice(*np.searchsorted(self.index, (frame, frame + 1)))]

    def normals(self, contacts: Table) -> Floats:
        """The unit normals of contacts: a trace does not contain those of surfaces."""
        of_surfaces = [normal for _, normal, _ in self.scene.surfaces] or [(np.nan, np.nan)]
        missing = np.isnan(contacts["direction"])
        return np.where(missing, np.asarray(of_surfaces)[contacts["surface"]], contacts["direction"])
