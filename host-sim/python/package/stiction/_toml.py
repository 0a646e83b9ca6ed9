"""The text of a scene file from Python's values; only the reader of scene files validates them."""

from __future__ import annotations

import json
import numbers
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from ._types import Obstacle, Surface


def value(given: Any) -> str:
    """A value in TOML."""
    if isinstance(given, str):
        # A JSON string is a TOML string, except for one character.
        return json.dumps(given, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(given, (bool, np.bool_)):
        return "true" if given else "false"
    if isinstance(given, numbers.Real):
        return repr(float(given))
    try:
        elements = list(given)
    except TypeError:
        raise ValueError(f"the scene contains {given!r}, allowed: numbers, text, and sequences of them") from None
    return "[" + ", ".join(value(element) for element in elements) + "]"


def key(given: object) -> str:
    """A key, which the reader of scene files validates."""
    return value(str(given))


def section(header: str, entries: Mapping[str, Any]) -> str:
    """A section with all entries that are not None; empty if there are none."""
    lines = [f"{key(name)} = {value(given)}" for name, given in entries.items() if given is not None]
    return "\n".join([header, *lines, "", ""]) if lines else ""


def scene(
    body: Mapping[str, Any],
    grasp: Mapping[str, Any],
    spring: Mapping[str, Any],
    surfaces: Iterable[Surface],
    obstacles: Iterable[Obstacle],
) -> str:
    """The text of a scene."""
    parts = [("[body]", body), ("[grasp]", grasp), ("[spring]", spring)]
    parts += [("[[surface]]", surface) for surface in surfaces]
    parts += [("[[obstacle]]", obstacle) for obstacle in obstacles]
    return "".join(section(header, entries) for header, entries in parts)
