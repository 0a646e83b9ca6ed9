"""The tables of a run: numpy's structured arrays with the fields of `src/rows.rs`, and the same tables for pandas and Parquet."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _stiction
from ._types import EventName, StateName, StatusName

if TYPE_CHECKING:
    import pandas

Table = npt.NDArray[np.void]

#: The contact states, in the order of their numbers.
STATES: tuple[StateName, ...] = tuple(_stiction.STATES)
#: The statuses, which state what limited an answer, in the order of their numbers; the first one is "ok".
STATUSES: tuple[StatusName, ...] = tuple(_stiction.STATUSES)
#: The events of a frame, in the order of their numbers.
EVENTS: tuple[EventName, ...] = tuple(_stiction.EVENTS)

#: A frame: time `t` (s); `hand` x, y (m), phi (rad); `pose` of the body, x, y (m), theta (rad); `depth` coordinate (m); `wrench` of the
#: hand on the body, force x, y (N) and moment about the holding point (N m); the longest slip that ended in it (m); the fraction of the hand's
#: displacement that is left to follow, `behind`, 0 to 1, nan without a budget; how many slips ended; whether the hand held; numbers of
#: `STATES` and `STATUSES`.
FRAME = np.dtype(
    [
        ("t", "f8"),
        ("hand", "f8", 3),
        ("pose", "f8", 3),
        ("depth", "f8"),
        ("wrench", "f8", 3),
        ("longest_slip", "f8"),
        ("behind", "f8"),
        ("slips", "u4"),
        ("held", "?"),
        ("state", "u1"),
        ("status", "u1"),
    ],
    align=True,
)
#: A contact: the `point` (m, world frame); the unit normal towards the body, `direction`, nan where a trace does not have it: in scenes
#: without obstacles it is the surface's; the `normal` force, 0 or more, and the `friction` along t = (n_y, -n_x), on the body (N); the
#: number of its `frame`; the touching features, by numbers from 0, -1 if absent: vertex on surface, vertex on a side of an obstacle, or
#: corner of an obstacle on a side of the body; `sliding` 0 while it sticks, 1 or -1 along t or against it.
CONTACT = np.dtype(
    [
        ("point", "f8", 2),
        ("direction", "f8", 2),
        ("normal", "f8"),
        ("friction", "f8"),
        ("frame", "u4"),
        ("surface", "i2"),
        ("obstacle", "i2"),
        ("side", "i2"),
        ("corner", "i2"),
        ("vertex", "i1"),
        ("body_side", "i1"),
        ("sliding", "i1"),
    ],
    align=True,
)
#: An event: the number of its `frame`, and a number of `EVENTS`.
EVENT = np.dtype([("frame", "u4"), ("event", "u1")], align=True)

#: The columns into which a field with several numbers is split, named as in a CSV trace.
PARTS = {
    "hand": ("hand_x", "hand_y", "hand_phi"),
    "pose": ("pose_x", "pose_y", "pose_theta"),
    "wrench": ("wrench_x", "wrench_y", "wrench_moment"),
    "point": ("x", "y"),
    "direction": ("direction_x", "direction_y"),
}


def names(dtype: np.dtype[Any]) -> tuple[str, ...]:
    """The fields of a table."""
    return dtype.names or ()


def columns(table: Table) -> dict[str, npt.NDArray[Any]]:
    """A table as columns of plain numbers, by name."""
    taken = {}
    for name in names(table.dtype):
        if name in PARTS:
            for i, part in enumerate(PARTS[name]):
                taken[part] = table[name][:, i]
        else:
            taken[name] = table[name]
    return taken


def table(dtype: np.dtype[Any], taken: Mapping[str, Any], length: int) -> Table:
    """The table of a type from columns, the inverse of `columns`; the error about a missing column names it."""
    made = np.zeros(length, dtype)
    for name in names(dtype):
        for i, part in enumerate(PARTS.get(name, (name,))):
            if part not in taken:
                raise ValueError(f"the column `{part}` is missing")
            to = made[name][:, i] if name in PARTS else made[name]
            to[...] = np.asarray(taken[part])
    return made


def named(given: npt.NDArray[Any], known: Sequence[str]) -> pandas.Categorical[str]:
    """Numbers as their names, for pandas."""
    import pandas

    return pandas.Categorical.from_codes(given.astype(np.int8), categories=pandas.Index(known))


def numbers(column: str, known: Sequence[str], given: Any) -> list[int]:
    """Names as their numbers; an unknown name is an error."""
    unknown = set(given) - set(known)
    if unknown:
        raise ValueError(f"`{column}` has {sorted(map(str, unknown))}, allowed: {', '.join(known)}")
    return [known.index(name) for name in given]


def read_only(words: npt.NDArray[np.uint64], dtype: np.dtype[np.void]) -> Table:
    """Words of the compiled half as a table that cannot be written to."""
    words.flags.writeable = False
    return words.view(dtype)


def contacts(count: int, rows: bytes) -> Table:
    """The contacts of a frame, from the compiled half, which calls it: faster than a view of words."""
    return np.ndarray(count, CONTACT, rows)


def words(table: Table, dtype: np.dtype[Any]) -> npt.NDArray[np.uint64]:
    """A copy of a table in the layout of the compiled half."""
    copy = np.array(table, dtype, ndmin=1)
    return copy.view(np.uint64)
