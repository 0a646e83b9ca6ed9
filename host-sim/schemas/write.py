#!/usr/bin/env python3
"""Writes the schemas of scene files and of records of a trace, and the list of the columns of a trace:

    python3 host-sim/schemas/write.py

The names and meanings of keys and columns are read from the tables in host-sim/SCENES.md and host-sim/TRACES.md, which tests compare with the program.
This file has only what these tables lack: types, lengths of arrays, minimum values.
"""

import csv
import io
import json
import pathlib
import re

HERE = pathlib.Path(__file__).resolve().parent
DOCUMENTS = [HERE.parent / "SCENES.md", HERE.parent / "TRACES.md"]

# Raised when a previously valid file no longer is.
VERSION = 1
DRAFT = "http://json-schema.org/draft-07/schema#"

NUMBER = {"type": "number"}
AT_LEAST_0 = {"type": "number", "minimum": 0}
POSITIVE = {"type": "number", "exclusiveMinimum": 0}
INDEX = {"type": "integer", "minimum": 0}
TEXT = {"type": "string"}
TRUTH = {"type": "boolean"}


def numbers(count, each=NUMBER):
    """An array of this many numbers."""
    return {"type": "array", "items": each, "minItems": count, "maxItems": count}


def table(text, name):
    """The rows of a table of the documents, as lists of cells."""
    inside = text.split(f"<!-- {name}: begin -->")[1].split(f"<!-- {name}: end -->")[0]
    lines = [line for line in inside.splitlines() if line.startswith("| `")]
    return [[cell.strip() for cell in line.strip().strip("|").split("|")] for line in lines]


def prose(cell):
    """A cell without the targets of its links."""
    return re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", cell)


def names(cell):
    """The names in a cell: what is between backticks."""
    return re.findall(r"`([a-z-]+)`", cell)


# Scene files.


def corners(most, least=1):
    """A list of different points."""
    limits = {"minItems": least, "uniqueItems": True} | ({"maxItems": most} if most else {})
    return {"type": "array", "items": numbers(2), **limits}


def keyframes():
    """t, x, y, phi and, if present, held."""
    items = [NUMBER, NUMBER, NUMBER, NUMBER, {"enum": [0, 1]}]
    frame = {"type": "array", "items": items, "additionalItems": False, "minItems": 4}
    return {"type": "array", "items": frame, "minItems": 1}


def shapes(room):
    """The type of each key, and its allowed values as far as they do not depend on another key. `room`: the most vertices."""
    friction = {"static": AT_LEAST_0, "dynamic": AT_LEAST_0, "memory": AT_LEAST_0}
    return {
        "body": {
            "vertices": corners(room),
            "rectangle": numbers(2, POSITIVE),
            "start": numbers(3),
            "weight": AT_LEAST_0,
            "repair": TRUTH,
        },
        "grasp": {"point": numbers(2), "reach": AT_LEAST_0},
        "spring": {"translation": POSITIVE, "rotation": AT_LEAST_0},
        "friction": friction,
        "surface": {
            "name": TEXT,
            "normal": numbers(2) | {"not": {"const": [0, 0]}},
            "offset": NUMBER,
            **friction,
        },
        "obstacle": {"name": TEXT, "vertices": corners(None), **friction},
        "hand": {
            "rate": POSITIVE,
            "keyframes": keyframes(),
            "path": {"type": "string", "pattern": r"\.(csv|tum|txt)$"},
            "plane": {"type": "string", "pattern": "^-?(x-?[yz]|y-?[xz]|z-?[xy])$"},
            "scale": POSITIVE,
            "origin": numbers(3),
            "angle": {"enum": ["radians", "degrees"]},
            "unwrap": TRUTH,
        },
    }


def needs_friction(name):
    """If `[friction]` does not give a coefficient, each surface and obstacle does."""
    each = {"items": {"required": [name]}}
    given = {"required": ["friction"], "properties": {"friction": {"required": [name]}}}
    return {"if": {"not": given}, "then": {"properties": {"surface": each, "obstacle": each}}}


def scene(text):
    """The schema of a scene file."""
    rows = {row[0].strip("`"): row[1:] for row in table(text, "keys")}
    room = int(re.search(r"(\d+) to (\d+) of", rows["body.vertices"][2])[2])
    counts = {kind: int(re.search(rf"for each {kind}, 0 to (\d+)", text)[1]) for kind in ("surface", "obstacle")}
    sections = {}
    for section, keys in shapes(room).items():
        properties = {}
        for key, shape in keys.items():
            meaning, default, allowed = rows.pop(f"{section}.{key}")
            told = f"{prose(meaning)}. Default: {prose(default)}. Allowed: {prose(allowed)}."
            properties[key] = {"description": told, **shape}
        needed = [key for key in keys if properties[key]["description"].find("Default: needed.") >= 0]
        one = {"type": "object", "additionalProperties": False, "properties": properties}
        one |= {"required": needed} if needed else {}
        count = counts.get(section)
        sections[section] = {"type": "array", "maxItems": count, "items": one} if count else one
    if rows:
        raise SystemExit(f"no type is known for {', '.join(rows)}")
    sections["body"]["oneOf"] = [{"required": ["vertices"]}, {"required": ["rectangle"]}]
    sections["hand"]["not"] = {"required": ["keyframes", "path"]}
    return {
        "$schema": DRAFT,
        "$id": f"urn:stiction:scene:{VERSION}",
        "title": "Scene file of stiction",
        "description": "A body, the surfaces and obstacles that it may touch, and the hand that holds it. SI units.",
        "type": "object",
        "additionalProperties": False,
        "required": [name for name in sections if name in ("body", "spring")],
        "properties": sections,
        "allOf": [needs_friction("static"), needs_friction("dynamic")],
    }


# Traces.

RECORD = {
    "t": NUMBER,
    "hand": numbers(3),
    "held": {"type": "boolean"},
    "pose": numbers(3),
    "depth": NUMBER,
    "state": {"enum": None},
    "contacts": None,
    "wrench": numbers(3),
    "slips": INDEX,
    "events": {"type": "array", "items": {"enum": None}},
    "status": {"enum": None},
}
CONTACT = {
    "vertex": INDEX,
    "corner": INDEX,
    "surface": TEXT,
    "obstacle": TEXT,
    "side": INDEX,
    "body_side": INDEX,
    "point": numbers(2),
    "normal": AT_LEAST_0,
    "friction": NUMBER,
    "sliding": {"enum": [-1, 0, 1]},
    "direction": numbers(2),
}
# The keys of each kind of contact: a vertex on a surface, a vertex on a side of an obstacle, a corner of one on a side of the body.
KINDS = [["vertex", "surface"], ["vertex", "obstacle", "side"], ["corner", "obstacle", "body_side"]]
INSERTION = {
    "depth": POSITIVE,
    "fx": NUMBER,
    "fz": NUMBER,
    "m": NUMBER,
    "lambda": {"type": ["number", "null"]},
    "margin": {"type": ["number", "null"]},
    "verdict": {"enum": None},
}
# Not in every record.
SOMETIMES = {"insertion": None, "behind": {"type": "number", "minimum": 0, "maximum": 1}}


def meanings(text):
    """The meaning of each key of a record, by its path: `contacts[0].vertex`."""
    told = {}
    for _, keys, meaning in table(text, "columns"):
        first = None
        for key in re.findall(r"`([^`]+)`", keys):
            first = first or key
            path = key if not key.startswith(".") else first.rsplit(".", 1)[0] + key
            told[path] = prose(meaning)
    return told


def described(shapes, told, prefix=""):
    """Shapes with their meanings; an empty list of names is taken from the meaning."""
    properties = {}
    for key, shape in shapes.items():
        if shape is None:
            continue
        meaning = told[prefix + key]
        shape = json.loads(json.dumps(shape))
        holder = shape.get("items", shape) if isinstance(shape.get("items"), dict) else shape
        if "enum" in holder and holder["enum"] is None:
            holder["enum"] = names(meaning)
        properties[key] = {"description": meaning, **shape}
    return properties


def trace(text):
    """The schema of a record of a trace, a line of a file in JSON Lines. Other keys may be added to records."""
    told = meanings(text)
    contact = {
        "type": "object",
        "required": ["point", "normal", "friction", "sliding"],
        "properties": described(CONTACT, told, "contacts[0]."),
        "oneOf": [{"required": kind, "not": {"anyOf": others(kind)}} for kind in KINDS],
    }
    insertion = {
        "description": "Whitney's meter, while a peg is in its hole.",
        "type": "object",
        "required": list(INSERTION),
        "properties": described(INSERTION, told, "insertion."),
    }
    properties = described(RECORD | SOMETIMES, told)
    properties["contacts"] = {"description": "What touches.", "type": "array", "items": contact}
    properties["insertion"] = insertion
    return {
        "$schema": DRAFT,
        "$id": f"urn:stiction:trace:{VERSION}",
        "title": "Record of a trace of stiction",
        "description": "A frame of the hand and where the body is then; a line of a file in JSON Lines. SI units.",
        "type": "object",
        "required": list(RECORD),
        "properties": properties,
    }


def others(kind):
    """The keys of the other kinds of contacts."""
    keys = sorted({key for other in KINDS for key in other if key not in kind})
    return [{"required": [key]} for key in keys]


def units(meaning, count):
    """The units of the columns: those in brackets. Where three columns share two, the third is a moment."""
    given = [unit for bracket in re.findall(r"\[([^]]+)\]", meaning) for unit in bracket.split(", ")]
    if len(given) == 2 and count == 3:
        given.insert(0, given[0])
    if len(given) < 2:
        given = (given or [""]) * count
    if len(given) != count:
        raise SystemExit(f"{count} columns have {len(given)} units: {meaning}")
    return given


def columns(text):
    """The columns of a trace in CSV, those of the first contact for each: name, unit, path in a record, meaning."""
    told = io.StringIO()
    rows = csv.writer(told, lineterminator="\n")
    rows.writerow(["column", "unit", "json", "meaning"])
    for cells, keys, meaning in table(text, "columns"):
        cells, keys = re.findall(r"`([^`]+)`", cells), re.findall(r"`([^`]+)`", keys)
        keys = [keys[0].rsplit(".", 1)[0] + key if key.startswith(".") else key for key in keys]
        if len(keys) != len(cells):
            keys = [f"{keys[0]}[{k}]" for k in range(len(cells))] if keys else [""]
        meaning = prose(meaning).replace("`", "")
        for cell, unit, key in zip(cells, units(meaning, len(cells)), keys, strict=True):
            rows.writerow([cell, unit, key, meaning])
    return told.getvalue()


def files():
    """The text of each written file, by its name."""
    text = "".join(document.read_text(encoding="utf-8") for document in DOCUMENTS)
    as_json = lambda schema: json.dumps(schema, indent=2, ensure_ascii=False) + "\n"  # noqa: E731
    return {
        "scene.schema.json": as_json(scene(text)),
        "trace.schema.json": as_json(trace(text)),
        "trace-columns.csv": columns(text),
    }


if __name__ == "__main__":
    for name, content in files().items():
        (HERE / name).write_text(content, encoding="utf-8", newline="\n")
        print(HERE / name)
