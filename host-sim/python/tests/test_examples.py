"""The examples run: the README's first lines, the first plot, the notebook."""

import pathlib
import re

from xml.etree import ElementTree

import nbformat
import numpy as np
from matplotlib.image import imread
from nbclient import NotebookClient
from stiction import _sheet

HERE = pathlib.Path(__file__).resolve().parents[1]


def pixels(file):
    """The pixels of a picture, 0 to 1."""
    return imread(file)[:, :, :3]


def test_the_first_lines_of_the_readme_run(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    code = re.search(r"```python\n(.*?)```", (HERE / "README.md").read_text(), re.DOTALL).group(1)
    exec(compile(code, "README.md", "exec"), {})
    # The picture below these lines is what they make.
    made, shown = (pixels(folder / "run.png") for folder in (tmp_path, HERE))
    assert made.shape == shown.shape and np.abs(made - shown).mean() < 0.01


def test_the_first_plot(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    file = HERE / "examples" / "first_plot.py"
    exec(compile(file.read_text(), file, "exec"), {})
    assert "1000 frames" in capsys.readouterr().out
    assert (tmp_path / "run.png").stat().st_size > 10_000


def test_the_notebook():
    notebook = nbformat.read(HERE / "examples" / "friction.ipynb", as_version=4)
    # `jupyter execute --inplace friction.ipynb` writes what is stored.
    stored = [list(shown(cell)) for cell in notebook.cells]
    NotebookClient(notebook, timeout=300, kernel_name="python3").execute()
    assert [list(shown(cell)) for cell in notebook.cells] == stored
    outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    pictures = [output.data["image/svg+xml"] for output in outputs if "image/svg+xml" in output.get("data", ())]
    assert len(pictures) == 3
    for picture in pictures:
        # The forces and the band of states are drawn, and letters as paths.
        assert ElementTree.fromstring(picture).tag.endswith("svg")
        assert all(color in picture for color in (_sheet.NORMAL, _sheet.FRICTION, _sheet.HAND_X)) and "<text" not in picture


def shown(cell):
    """What a reader sees below a cell: text, and where there are pictures."""
    for output in cell.get("outputs", []):
        if output.output_type == "stream":
            yield output.text
        else:
            yield "a picture" if "image/svg+xml" in output.data else output.data["text/plain"]
