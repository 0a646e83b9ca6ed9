import os
import pathlib
import subprocess

import pytest

WORKSPACE = pathlib.Path(__file__).resolve().parents[3]


@pytest.fixture(scope="session")
def program():
    """The program `stiction`: from the variable STICTION, or built by cargo for tests."""
    target = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", WORKSPACE / "target"))
    return os.environ.get("STICTION", WORKSPACE / target / "debug" / "stiction")


@pytest.fixture(scope="session")
def stiction_run(program, tmp_path_factory):
    """Runs a scene with the program; returns the file of its trace."""

    def run(scene, *options):
        trace = tmp_path_factory.mktemp("run") / "trace.jsonl"
        arguments = [program, "run", scene, "--out", trace, "--quiet", *options]
        subprocess.run([os.fspath(argument) for argument in arguments], check=True)
        return trace

    return run
