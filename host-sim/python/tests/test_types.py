"""Types and documentation, checked with the tools of users."""

import doctest
import inspect
import pathlib
import subprocess
import sys
from typing import Literal, get_args, get_origin

import pytest
import stiction

HERE = pathlib.Path(__file__).resolve().parents[1]


@pytest.mark.parametrize(
    "command", [["mypy", "--strict", "-p", "stiction"], ["mypy.stubtest", "stiction._stiction"]], ids=["mypy", "stubtest"]
)
def test_types(command, tmp_path):
    config = ["--config-file" if command[0] == "mypy" else "--mypy-config-file", str(HERE / "pyproject.toml")]
    program, *arguments = command
    outcome = subprocess.run(
        [sys.executable, "-m", program, *config, *arguments], cwd=tmp_path, capture_output=True, text=True
    )
    assert outcome.returncode == 0, outcome.stdout + outcome.stderr


def public():
    """Names and values of the public interface."""
    for name in stiction.__all__:
        value = getattr(stiction, name)
        yield name, value
        if inspect.isclass(value):
            for of_class, member in vars(value).items():
                if not of_class.startswith("_") and (callable(member) or isinstance(member, (property, classmethod)) or inspect.isgetsetdescriptor(member)):
                    yield f"{name}.{of_class}", member


@pytest.mark.parametrize(("name", "value"), [pair for pair in public() if not isinstance(pair[1], (tuple, str)) and get_origin(pair[1]) is not Literal])
def test_everything_public_is_documented(name, value):
    assert name in ("CONTACT", "EVENT", "FRAME") or len(inspect.getdoc(value) or "") > 15


@pytest.mark.parametrize("kind", ["State", "Status", "Event"])
def test_the_types_have_the_names(kind):
    names = getattr(stiction, {"State": "STATES", "Status": "STATUSES", "Event": "EVENTS"}[kind])
    assert get_args(getattr(stiction, f"{kind}Name")) == names


USE = '''
import numpy as np
import stiction

floor: stiction.Surface = {"normal": (0, 1), "offset": 0, "static": 0.5, "dynamic": 0.3}
wall = stiction.Surface(name="wall", normal=np.array([1.0, 0.0]), offset=-1.0, static=0.5, dynamic=0.3)
pin = stiction.Obstacle(vertices=[(0.5, 0.0)], static=0.5, dynamic=0.3)
box = [(-0.05, -0.03), (0.05, -0.03), (0.05, 0.03), (-0.05, 0.03)]
scene = stiction.Scene(vertices=box, translation=500, start=(0, 0.03, 0), surfaces=[floor, wall], obstacles=[pin])
solver = stiction.Solver(scene, number="f64")
slips: int = solver.step(0.0, 0.02, 0.0).slips
axes = solver.run(np.zeros((3, 3))).figure("forces", width=85, between=(0.0, 1.0))
'''


@pytest.mark.parametrize(
    "fault",
    [
        "",
        'stiction.Solver(scene, number="f16")',
        'stiction.Solver(scene, evolution="leap")',
        'solver.step(0.0, 0.0, 0.0).state == "flying"',
        'solver.run(np.zeros((3, 3))).figure("force")',
        'stiction.Scene(vertices=box, translation=500, surfaces=[{"normal": (0, 1), "offset": 0, "static": 0.5}])',
        'stiction.Surface(normal=(0, 1), offset=0, static=0.5, dynamic=0.3, colour="red")',
    ],
)
def test_a_checker_of_types_finds_a_wrong_name(fault, tmp_path):
    file = tmp_path / "use.py"
    file.write_text(USE + fault)
    outcome = subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--strict-equality", "use.py"], cwd=tmp_path, capture_output=True, text=True
    )
    found = [line for line in outcome.stdout.splitlines() if "error:" in line]
    assert [line.split(":")[1] for line in found] == ([str(len(USE.splitlines()) + 1)] if fault else []), outcome.stdout


def test_the_first_example_runs():
    assert doctest.testmod(stiction).failed == 0
