"""The schemas of scene files and traces: written from the documentation as it is, and in agreement with the program."""

import copy
import csv
import importlib.util
import json
import subprocess
import tomllib

import jsonschema
import pytest
from conftest import WORKSPACE

SCHEMAS = WORKSPACE / "host-sim/schemas"
BUNDLED = sorted((WORKSPACE / "host-sim/scenes").glob("*.toml"))

SCENE = {
    "body": {"vertices": [[-0.05, -0.03], [0.05, -0.03], [0.05, 0.03]], "start": [0.2, 0.12, 0.5], "weight": 1.0},
    "grasp": {"point": [0.0, 0.02], "reach": 0.01},
    "spring": {"translation": 500.0, "rotation": 0.5},
    "friction": {"static": 0.5, "dynamic": 0.3, "memory": 1e-5},
    "surface": [
        {"name": "floor", "normal": [0.0, 1.0], "offset": 0.0, "static": 0.6, "dynamic": 0.4, "memory": 1e-5},
        {"normal": [1.0, 0.0], "offset": 0.0},
    ],
    "obstacle": [
        {"name": "pin", "vertices": [[0.0, 0.5]], "static": 0.6, "dynamic": 0.4, "memory": 1e-5},
        {"name": "block", "vertices": [[0.4, 0.0], [0.6, 0.0], [0.6, 0.1]]},
    ],
    "hand": {
        "rate": 10.0,
        "keyframes": [[0.0, 0.2, 0.14, 0.5], [0.5, 0.2, 0.06, 0.5, 0.0]],
        "plane": "xy",
        "scale": 1.0,
        "origin": [0.0, 0.0, 0.0],
    },
}


def is_compared(at, change):
    """A change that the program refuses because of other values, or what may be given elsewhere: beyond what a schema says."""
    if change == "removed":
        # The rate as --rate, the motion as --hand; without a name the obstacle is `1`, as the surface is.
        return at in {("hand",), ("hand", "rate"), ("hand", "keyframes"), ("obstacle", 1, "name")}
    if change == "0" and at[-1] == "static":
        return True  # less than the dynamic friction
    # The shape of body and obstacle, the body inside of something, times that do not increase.
    geometry = {("body", "vertices"), ("body", "start"), ("surface", "normal"), ("obstacle", "vertices"), ("hand", "keyframes")}
    return change in {"0", "-1"} and (at[0], next(key for key in at[1:] if isinstance(key, str))) in geometry


def toml(value):
    """A value in TOML."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} = {toml(inner)}" for key, inner in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(toml, value)) + "]"
    return json.dumps(value)


def places(value, at=()):
    """The place of every value in a document, as a path of keys and indices."""
    inner = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, one in inner:
        yield (*at, key)
        yield from places(one, (*at, key))


def changes(at):
    """The document with one change at a place, under the name of the change."""
    for name, new in [("text", "up"), ("true", True), ("0", 0), ("-1", -1.0), ("empty", []), ("nested", [[0.0]]), ("removed", None)]:
        changed = copy.deepcopy(SCENE)
        holder = changed
        for key in at[:-1]:
            holder = holder[key]
        if name == "removed":
            del holder[at[-1]]
        else:
            holder[at[-1]] = new
        yield name, changed
    if isinstance(holder, dict):
        renamed = copy.deepcopy(SCENE)
        holder = renamed
        for key in at[:-1]:
            holder = holder[key]
        holder[f"{at[-1]}s"] = holder.pop(at[-1])
        yield "renamed", renamed


@pytest.fixture(scope="module")
def write():
    """The command that writes the schemas, as a module."""
    spec = importlib.util.spec_from_file_location("write", SCHEMAS / "write.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def validator(name):
    schema = json.loads((SCHEMAS / f"{name}.schema.json").read_text(encoding="utf-8"))
    jsonschema.Draft7Validator.check_schema(schema)
    return jsonschema.Draft7Validator(schema)


def test_the_files_are_those_that_the_command_writes(write):
    for name, content in write.files().items():
        assert (SCHEMAS / name).read_text(encoding="utf-8") == content, f"python3 host-sim/schemas/write.py writes another {name}"


@pytest.mark.parametrize("file", BUNDLED, ids=lambda file: file.stem)
def test_bundled_scenes_fit_the_schema(file):
    validator("scene").validate(tomllib.loads(file.read_text(encoding="utf-8")))


def test_what_the_schema_refuses_the_program_refuses(program, tmp_path):
    """And, but for what compares values, the other way round: every value is replaced by others in turn, left out and renamed."""
    schema, file = validator("scene"), tmp_path / "scene.toml"

    def accepts(document):
        file.write_text("\n".join(f"{key} = {toml(value)}" for key, value in document.items()), encoding="utf-8")
        return subprocess.run([program, "run", file, "--quiet"], capture_output=True, check=False).returncode == 0

    assert accepts(SCENE)
    schema.validate(SCENE)
    only_schema, only_program = [], []
    for at in places(SCENE):
        for name, document in changes(at):
            fits, runs = schema.is_valid(document), accepts(document)
            if runs and not fits:
                only_schema.append((at, name))
            if fits and not runs and not is_compared(at, name):
                only_program.append((at, name))
    assert (only_schema, only_program) == ([], [])


@pytest.mark.parametrize(
    ("scene", "options"),
    [
        ("vertex-stick-slip", ["--number", "f32"]),
        ("corner-stick-slip", ["--number", "fixed"]),
        ("locked", ["--number", "f64", "--evolution", "frame"]),
        ("table-edge", ["--number", "f32"]),
        ("hook", ["--number", "fixed"]),
        ("peg-in-hole", ["--number", "f32", "--budget", "1"]),
    ],
)
def test_records_fit_the_schema(stiction_run, scene, options):
    """Every record of a run at 100 Hz, which has no key that the schema does not know."""
    schema = validator("trace")
    known = schema.schema["properties"]
    records = [json.loads(line) for line in stiction_run(scene, "--rate", "100", *options).read_text().splitlines()]
    assert len(records) > 100
    for record in records:
        schema.validate(record)
        assert set(record) <= set(known)
        for contact in record["contacts"]:
            assert set(contact) <= set(known["contacts"]["items"]["properties"])
        assert set(record.get("insertion", ())) <= set(known["insertion"]["properties"])


def test_records_that_mean_nothing_are_refused(stiction_run):
    schema = validator("trace")
    lines = stiction_run("table-edge", "--rate", "50").read_text().splitlines()
    records = [json.loads(line) for line in lines]
    record = next(record for record in records if any("vertex" in contact for contact in record["contacts"]))

    def refused(change):
        changed = copy.deepcopy(record)
        change(changed)
        assert not schema.is_valid(changed), changed

    def refused_in_contact(change):
        refused(lambda record: change(next(contact for contact in record["contacts"] if "vertex" in contact)))

    schema.validate(record)
    for key in schema.schema["required"]:
        refused(lambda place, key=key: place.pop(key))
    for key, value in [
        ("state", "flying"),
        ("status", "fine"),
        ("events", ["touch", "bounce"]),
        ("pose", [0.0, 0.0]),
        ("t", None),
        ("slips", -1),
        ("held", 1),
        ("behind", 1.5),
    ]:
        refused(lambda place, key=key, value=value: place.update({key: value}))
    for key, value in [("normal", -1.0), ("sliding", 2), ("corner", 0), ("vertex", 0.5), ("point", [0.0])]:
        refused_in_contact(lambda place, key=key, value=value: place.update({key: value}))
    refused_in_contact(lambda place: place.pop("vertex"))


def test_the_columns_are_those_of_a_trace_in_csv(program, tmp_path):
    """Of a run with all of them: a peg in a hole with a budget."""
    out = tmp_path / "trace.csv"
    subprocess.run([program, "run", "peg-in-hole", "--rate", "20", "--budget", "1", "--out", out, "--quiet"], check=True)
    with out.open(encoding="utf-8", newline="") as file:
        header = next(csv.reader(file))
    with (SCHEMAS / "trace-columns.csv").open(encoding="utf-8", newline="") as file:
        columns = [row["column"] for row in csv.DictReader(file)]
    assert columns == [name for name in header if not name.startswith(("c1_", "c2_", "c3_"))]
