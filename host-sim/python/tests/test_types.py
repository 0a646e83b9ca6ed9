"""Types and documentation, checked with the tools of users."""

import doctest
import inspect
import pathlib
import subprocess
import sys

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
                if not of_class.startswith("_") and (callable(member) or isinstance(member, (property, classmethod))):
                    yield f"{name}.{of_class}", member


@pytest.mark.parametrize(("name", "value"), [pair for pair in public() if not isinstance(pair[1], (tuple, str))])
def test_everything_public_is_documented(name, value):
    assert name in ("CONTACT", "EVENT", "FRAME") or len(inspect.getdoc(value) or "") > 15


def test_the_first_example_runs():
    assert doctest.testmod(stiction).failed == 0
