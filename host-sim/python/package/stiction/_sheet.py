"""What the pictures of a run have in common: sizes, colors, legends."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Union

from matplotlib.axes import Axes
from matplotlib.figure import Figure, SubFigure
from matplotlib.lines import Line2D
from matplotlib.textpath import TextPath
from matplotlib.ticker import MaxNLocator
from matplotlib.transforms import ScaledTranslation

from ._types import StateName

#: What pictures are drawn into.
Sheet = Union[Figure, SubFigure]

#: Sizes of text (pt): journals ask for 7 to 9 at the printed width.
TEXT, SMALL = 8.0, 7.0
MM = 1 / 25.4  # inches

# Colors that color-blind readers can distinguish (Okabe and Ito), as in the pictures of `stiction run --plot`.
INK, FAINT, SOLID = "#222222", "#787878", "#eeece8"
HAND, OPEN_HAND, BODY, BODY_THEN = "#000000", "#aaaaaa", "#0072b2", "#78b0d4"
NORMAL, FRICTION, LIMIT, HAND_X, HAND_Y = "#009e73", "#d55e00", "#7a3200", "#e69f00", "#56b4e9"
STATE: dict[StateName, str] = {
    "non-contact": "#cdcdcd",
    "single-vertex": "#56b4e9",
    "edge": "#009e73",
    "two-vertex": "#e69f00",
    "corner": "#f0e442",
    "locked": "#cc79a7",
}

#: Width of the labels of an axis (mm).
AXIS = 14.0


def unit(extent: float) -> tuple[str, float]:
    """A unit of length that suits an extent (m), and how many of it make a metre."""
    return ("mm", 1e3) if extent < 2.0 else ("m", 1.0)


def legend_style(sheet: Sheet, entries: Sequence[Any]) -> dict[str, Any]:
    """How a legend looks that has room on a sheet."""
    handle, pad, spacing = 1.4, 0.8, 1.2  # sizes of the text
    longest = max(TextPath((0.0, 0.0), entry.get_label(), size=SMALL).get_extents().width for entry in entries)
    width = (longest + (handle + pad + spacing) * SMALL) / 72.0 / MM
    columns = max(1, int((size(sheet)[0] - AXIS) / width))
    return {
        "handles": entries,
        "ncols": min(columns, len(entries)),
        "fontsize": SMALL,
        "frameon": False,
        "handlelength": handle,
        "handletextpad": pad,
        "columnspacing": spacing,
        "borderaxespad": 0.2,
        "borderpad": 0.2,
    }


def legend(axes: Axes, sheet: Sheet, entries: Sequence[Any], down: float = 0.0) -> None:
    """A legend outside of the axes, so that it hides nothing: above them, or a distance (pt) below."""
    moved = ScaledTranslation(0.0, -down / 72.0, sheet.dpi_scale_trans)
    axes.legend(
        **legend_style(sheet, entries),
        loc="upper left" if down > 0.0 else "lower left",
        bbox_to_anchor=(0.0, 0.0) if down > 0.0 else (0.0, 1.0),
        bbox_transform=axes.transAxes + moved,
    )


def entry(color: str, label: str, **style: Any) -> Line2D:
    """An entry of a legend: a line or a marker."""
    return Line2D([], [], color=color, label=label, **{"linewidth": 1.2, **style})


def size(sheet: Sheet) -> tuple[float, float]:
    """Width and height of a sheet (mm)."""
    return sheet.bbox.width / sheet.dpi / MM, sheet.bbox.height / sheet.dpi / MM


def plain(axes: Axes) -> None:
    """The style of axes: two spines, small text, few ticks."""
    axes.tick_params(labelsize=SMALL, length=2.5, width=0.6)
    for name, spine in axes.spines.items():
        spine.set(linewidth=0.6, visible=name in ("left", "bottom"))
    for axis in (axes.xaxis, axes.yaxis):
        axis.label.set_fontsize(TEXT)
        axis.get_offset_text().set_fontsize(SMALL)
    # As many ticks, whatever the size: the layout depends on their labels, and they would depend on the layout.
    for axis in (axes.xaxis, axes.yaxis):
        if len(axis.get_ticklocs()) > 0:
            axis.set_major_locator(MaxNLocator(5, steps=[1, 2, 5, 10]))
