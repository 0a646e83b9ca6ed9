"""The examples run: the README's first lines, the first plot, the notebook."""

import pathlib
import re

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
