"""Types of arguments and answers, for type checkers."""

from __future__ import annotations

from typing import Literal, TypedDict

import numpy.typing as npt

#: The number types of a solver.
Number = Literal["f32", "f64", "fixed"]
#: The evolutions of a frame.
Evolution = Literal["path", "frame"]
#: The names in `STATES`.
StateName = Literal["non-contact", "single-vertex", "edge", "two-vertex", "corner", "locked"]
#: The names in `STATUSES`.
StatusName = Literal[
    "ok",
    "event-limit",
    "twist",
    "iteration-limit",
    "jammed",
    "behind",
    "ambiguous",
    "saturated",
    "held-last",
]
#: The names in `EVENTS`.
EventName = Literal[
    "touch", "lift", "slip", "tip", "land", "snap", "jam", "slide", "stop", "grasp", "release"
]
#: The pictures that `Run.figure` draws.
Picture = Literal["trajectory", "forces", "motion", "strip"]


class _Friction(TypedDict):
    static: float
    dynamic: float


class _Optional(_Friction, total=False):
    name: str
    memory: float


class Surface(_Optional):
    """A half-plane: a dictionary with `normal`, towards its free side (world frame, of any length above 0), and `offset` along the unit
    normal (m); the coefficients of friction `static` and `dynamic`, 0 or more and static >= dynamic; optionally `name` and `memory` (m).
    """

    normal: npt.ArrayLike
    offset: float


class Obstacle(_Optional):
    """A convex polygon, a wall or a pin: a dictionary with its corners `vertices` (m, world frame, counter-clockwise), (N, 2); the
    coefficients of friction `static` and `dynamic`, 0 or more and static >= dynamic; optionally `name` and `memory` (m).
    """

    vertices: npt.ArrayLike
