import os
import pathlib
import subprocess

import pytest

WORKSPACE = pathlib.Path(__file__).resolve().parents[3]


@pytest.fixture(scope="session")
def program():
    """The program `stiction`: that of STICTION, or what cargo has built for tests."""
    named = os.environ.get("STICTION")
    return pathlib.Path(named) if named else WORKSPACE / "target" / "debug" / "stiction"


@pytest.fixture
def stiction_run(program, tmp_path):
    """Runs a scene by the program: the records of its trace."""
    import json

    def run(scene, *options):
        trace = tmp_path / "trace.jsonl"
        arguments = [program, "run", scene, "--out", trace, "--quiet", *options]
        subprocess.run(arguments, check=True, stdout=subprocess.DEVNULL)
        return [json.loads(line) for line in trace.read_text().splitlines()]

    return run
