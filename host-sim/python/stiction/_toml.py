"""The text of a scene file from Python's values: what is wrong with them is said by what reads scene files, and nowhere else."""

from __future__ import annotations

import numbers

import numpy as np


def value(given):
    """A value as TOML has it."""
    if isinstance(given, str):
        escaped = given.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n")
        return f'"{escaped}"'
    if isinstance(given, (bool, np.bool_)):
        return "true" if given else "false"
    if isinstance(given, numbers.Real):
        return repr(float(given))
    return "[" + ", ".join(value(element) for element in given) + "]"


def section(header, entries):
    """A section with all entries that are not None; nothing where there are none."""
    lines = [f"{key} = {value(given)}" for key, given in entries.items() if given is not None]
    return "\n".join([header, *lines, "", ""]) if lines else ""


def scene(vertices, start, weight, holding_point, reach, translation, rotation, surfaces, obstacles):
    """The text of a scene."""
    text = section("[body]", {"vertices": vertices, "start": start, "weight": weight})
    text += section("[grasp]", {"point": holding_point, "reach": reach})
    text += section("[spring]", {"translation": translation, "rotation": rotation})
    for surface in surfaces:
        text += section("[[surface]]", surface)
    for obstacle in obstacles:
        text += section("[[obstacle]]", obstacle)
    return text
