"""Traces of the program, JSON Lines, as the tables of a run."""

from __future__ import annotations

import json
import os
from typing import TYPE_CHECKING, Any

import numpy as np

from ._tables import CONTACT, EVENT, EVENTS, FRAME, STATES, STATUSES, Table
from ._types import Number

if TYPE_CHECKING:
    from ._scene import Scene

INDICES = ("side", "corner", "vertex", "body_side")


def tables(
    scene: Scene, path: str | os.PathLike[str], number: Number
) -> tuple[Table, Table, Table]:
    """Frames, contacts and events of a trace."""
    places = {
        "surface": [name for name, _, _ in scene.surfaces],
        "obstacle": [name for name, _ in scene.obstacles],
    }
    frames: list[tuple[Any, ...]] = []
    contacts: list[tuple[Any, ...]] = []
    events: list[tuple[int, int]] = []
    with open(path, encoding="utf-8") as lines:
        for i, line in enumerate(lines):
            try:
                record = json.loads(line)
                frames.append(frame(record))
                contacts += (contact(i, given, places) for given in record["contacts"])
                events += ((i, EVENTS.index(event)) for event in record["events"])
            except (ValueError, TypeError, AttributeError) as error:
                raise ValueError(f"{os.fspath(path)}, line {i + 1}: {error}, allowed: a record of a trace") from None
            except KeyError as error:
                raise ValueError(f"{os.fspath(path)}, line {i + 1}: the key {error} is missing") from None
    made = np.array(frames, FRAME), np.array(contacts, CONTACT), np.array(events, EVENT)
    if number != "f64":
        for table in made[:2]:
            as_printed(table)
    return made


def frame(record: dict[str, Any]) -> tuple[Any, ...]:
    """The row of a record, which does not contain the longest slip."""
    return (
        record["t"],
        tuple(record["hand"]),
        tuple(record["pose"]),
        record["depth"],
        tuple(record["wrench"]),
        np.nan,
        record.get("behind", np.nan),
        record["slips"],
        record["held"],
        STATES.index(record["state"]),
        STATUSES.index(record["status"]),
    )


def contact(frame: int, given: dict[str, Any], places: dict[str, list[str]]) -> tuple[Any, ...]:
    """The row of a contact."""
    surface, obstacle = (names.index(given[key]) if key in given else -1 for key, names in places.items())
    side, corner, vertex, body_side = (given.get(key, -1) for key in INDICES)
    direction = tuple(given.get("direction", (np.nan, np.nan)))
    forces = (given["normal"], given["friction"])
    place = (frame, surface, obstacle, side, corner, vertex, body_side, given["sliding"])
    return (tuple(given["point"]), direction, *forces, *place)


def as_printed(table: Table) -> None:
    """Numbers printed with the digits of f32 as that f32; times are printed as f64."""
    for name in table.dtype.names or ():
        if table[name].dtype.base == np.float64 and name != "t":
            table[name] = table[name].astype(np.float32)
