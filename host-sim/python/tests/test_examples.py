"""The examples run: the README's first lines, the first plot, the notebook."""

import pathlib
import re
import subprocess
import sys

import nbformat
from nbclient import NotebookClient

HERE = pathlib.Path(__file__).resolve().parents[1]


def test_the_first_lines_of_the_readme_run(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    code = re.search(r"```python\n(.*?)```", (HERE / "README.md").read_text(), re.DOTALL).group(1)
    exec(compile(code, "README.md", "exec"), {})
    assert (tmp_path / "run.png").stat().st_size > 10_000


def test_the_first_plot(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    file = HERE / "examples" / "first_plot.py"
    exec(compile(file.read_text(), file, "exec"), {})
    assert "1000 frames" in capsys.readouterr().out
    assert (tmp_path / "run.png").stat().st_size > 10_000


def test_the_notebook():
    notebook = nbformat.read(HERE / "examples" / "friction.ipynb", as_version=4)
    NotebookClient(notebook, timeout=300, kernel_name="python3").execute()


def test_the_moving_picture_is_that_of_the_run(program, tmp_path):
    """As an example writes it; the bits of a run, and so the picture, are the same everywhere."""
    host, new = HERE.parent, tmp_path / "animation.svg"
    subprocess.run([sys.executable, host / "examples/animation.py", "--program", program, "--out", new], check=True)
    assert new.read_text(encoding="utf-8") == (host / "animation.svg").read_text(encoding="utf-8")
