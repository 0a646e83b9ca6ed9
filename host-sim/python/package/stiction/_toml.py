"""The text of a scene file from Python's values: what is wrong with them is said by what reads scene files, and nowhere else."""

from __future__ import annotations

import json
import numbers
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np


def value(given: Any) -> str:
    """A value as TOML has it."""
    if isinstance(given, str):
        # A string of JSON is one of TOML, but for one character.
        return json.dumps(given, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(given, (bool, np.bool_)):
        return "true" if given else "false"
    if isinstance(given, numbers.Real):
        return repr(float(given))
    try:
        elements = list(given)
    except TypeError:
        raise ValueError(f"{given!r} is in the scene, allowed: numbers, text, and sequences of them") from None
    return "[" + ", ".join(value(element) for element in elements) + "]"


def key(given: object) -> str:
    """A key, which need not be one of a scene: that is said by what reads it."""
    return value(str(given))


def section(header: str, entries: Mapping[str, Any]) -> str:
    """A section with all entries that are not None; nothing where there are none."""
    lines = [f"{key(name)} = {value(given)}" for name, given in entries.items() if given is not None]
    return "\n".join([header, *lines, "", ""]) if lines else ""


def scene(
    body: Mapping[str, Any],
    grasp: Mapping[str, Any],
    spring: Mapping[str, Any],
    surfaces: Iterable[Mapping[str, Any]],
    obstacles: Iterable[Mapping[str, Any]],
) -> str:
    """The text of a scene."""
    parts = [("[body]", body), ("[grasp]", grasp), ("[spring]", spring)]
    parts += [("[[surface]]", surface) for surface in surfaces]
    parts += [("[[obstacle]]", obstacle) for obstacle in obstacles]
    return "".join(section(header, entries) for header, entries in parts)
