"""Figures of a run with matplotlib: one picture for a paper, or all of them."""

from __future__ import annotations

import io
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import matplotlib
import numpy.typing as npt
from matplotlib.figure import Figure
from matplotlib.transforms import Bbox

from ._part import Part
from ._plane import strip, trajectory
from ._sheet import MM, TEXT, Sheet
from ._timeline import forces, motion
from ._types import Picture

if TYPE_CHECKING:
    from ._run import Run

#: Room around the parts of a picture (mm).
GAP = 2.0


class Drawing(Figure):
    """A figure that notebooks show as SVG."""

    def _repr_svg_(self) -> str:
        text = io.StringIO()
        with matplotlib.rc_context({"svg.hashsalt": "stiction"}):
            self.savefig(text, format="svg", metadata={"Date": None})
        return text.getvalue()


PICTURES: dict[Picture, Callable[[Part, Sheet], npt.NDArray[Any]]] = {
    "trajectory": trajectory,
    "forces": forces,
    "motion": motion,
    "strip": strip,
}


def figure(
    run: Run,
    picture: Picture,
    width: float,
    at: float | Sequence[float] | None,
    between: tuple[float, float] | None,
    title: str | None,
) -> npt.NDArray[Any]:
    """The axes of one picture."""
    if picture not in PICTURES:
        raise ValueError(f"`picture` is {picture!r}, allowed: {', '.join(PICTURES)}")
    if not 20.0 <= width <= 2000.0:
        raise ValueError(f"`width` is {width} mm, allowed: 20 to 2000")
    part = Part(run, between, at)
    # With room for a plane that is higher than wide.
    made = Drawing(figsize=(width * MM, 2.0 * width * MM + 1.0), layout="compressed")
    axes = PICTURES[picture](part, made)
    if title is not None:
        made.suptitle(title, fontsize=TEXT)
    if picture in ("trajectory", "strip"):
        # They are to scale, so that their width determines their height.
        made.draw_without_rendering()
        drawn = [where for where in (one.get_tightbbox() for one in made.axes) if where is not None]
        parts = [Bbox.union(drawn), *(beside.get_window_extent() for beside in [*made.legends, *made.texts])]
        made.set_figheight(sum(part.height for part in parts) / made.dpi + GAP * len(parts) * MM)
    return axes


def overview(run: Run) -> Figure:
    """All pictures in one figure."""
    part = Part(run, None, None)
    made = Drawing(figsize=(10, 9), layout="constrained")
    grid = made.add_gridspec(3, 2, height_ratios=(1.0, 1.1, 0.8))
    trajectory(part, made.add_subfigure(grid[0, 0]))
    motion(part, made.add_subfigure(grid[1, 0]))
    forces(part, made.add_subfigure(grid[:2, 1]))
    strip(part, made.add_subfigure(grid[2, :]))
    return made
