"""The tables of a run: numpy's structured arrays with the fields of `src/rows.rs`, and the same as pandas and Parquet have them."""

from __future__ import annotations

import numpy as np

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
CONTACT = np.dtype(
    [
        ("point", "f8", 2),
        ("direction", "f8", 2),
        ("normal", "f8"),
        ("friction", "f8"),
        ("frame", "u4"),
        ("vertex", "i2"),
        ("surface", "i2"),
        ("obstacle", "i2"),
        ("side", "i2"),
        ("corner", "i2"),
        ("body_side", "i2"),
        ("sliding", "i1"),
    ],
    align=True,
)
EVENT = np.dtype([("frame", "u4"), ("event", "u1")], align=True)

# The names of the columns into which a field with several numbers is taken apart.
PARTS = {
    "hand": ("hand_x", "hand_y", "hand_phi"),
    "pose": ("x", "y", "theta"),
    "wrench": ("fx", "fy", "moment"),
    "point": ("point_x", "point_y"),
    "direction": ("direction_x", "direction_y"),
}


def columns(table):
    """A table as columns of plain numbers, by name."""
    taken = {}
    for name in table.dtype.names:
        if name in PARTS:
            for i, part in enumerate(PARTS[name]):
                taken[part] = table[name][:, i]
        else:
            taken[name] = table[name]
    return taken


def table(dtype, taken, length):
    """The table of a type from columns, the reverse of `columns`; a column that is missing is an error that names it."""
    made = np.zeros(length, dtype)
    for name in dtype.names:
        for i, part in enumerate(PARTS.get(name, (name,))):
            if part not in taken:
                raise ValueError(f"the column `{part}` is missing")
            to = made[name][:, i] if name in PARTS else made[name]
            to[...] = np.asarray(taken[part])
    return made


def as_bytes(table):
    """The bytes of a table, as the compiled half takes them."""
    return np.frombuffer(np.ascontiguousarray(table).tobytes(), np.uint8)
