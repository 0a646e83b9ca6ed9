"""Pictures over time: forces and motion, above a band of the states."""

from __future__ import annotations

from collections.abc import Sequence
from textwrap import fill
from typing import Any

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from ._part import Floats, Part
from ._sheet import BODY, FAINT, FRICTION, HAND, HAND_X, HAND_Y, LIMIT, MM, NORMAL, OPEN_HAND, STATE
from ._sheet import Sheet, entry, legend, plain, size, unit
from ._tables import STATES

#: Heights (mm): of a panel, of the band of states, and of what is around them.
PANEL, BAND, AROUND = 24.0, 3.0, 27.0
#: Height of the ticks and of the label of time, which are above the legend of the states (pt).
BELOW = 27.0
#: The most letters in a line of a label, which is beside a panel.
LETTERS = 12
#: Columns into which the band of states is divided: finer ones are not seen.
COLUMNS = 900


def _spans(part: Part) -> tuple[Floats, npt.NDArray[np.intp]]:
    """Edges (s) and states of spans of time: of a column of many frames the state that is rarest in the part, so that none is lost."""
    state = part.frames["state"].astype(np.intp)
    counts = np.bincount(state, minlength=len(STATES))
    order = np.argsort(counts, kind="stable")
    starts = np.arange(0, len(state), -(-len(state) // COLUMNS))
    rarest = order[np.minimum.reduceat(np.argsort(order)[state], starts)]
    begins = np.r_[0, np.nonzero(np.diff(rarest))[0] + 1]
    return np.r_[part.t[starts[begins]], part.t[-1]], rarest[begins]


def _band(part: Part, axes: Axes, sheet: Sheet) -> None:
    """The state as a colored band over time, with the states that occur."""
    edges, states = _spans(part)
    colors = [STATE[STATES[state]] for state in states]
    axes.broken_barh(list(zip(edges, np.diff(edges))), (0.0, 1.0), facecolors=colors)
    occur = [STATES[state] for state in np.unique(part.frames["state"])]
    axes.set(ylim=(0.0, 1.0), yticks=[], xlabel="t (s)", ylabel="state")
    axes.yaxis.label.set(rotation=0, ha="right", va="center")
    if part.t.max() > part.t.min():
        axes.set_xlim(part.t.min(), part.t.max())
    entries = [Patch(facecolor=STATE[name], label=name) for name in occur]
    legend(axes, sheet, entries, down=BELOW)


def _over_time(part: Part, sheet: Sheet, labels: Sequence[str]) -> npt.NDArray[Any]:
    """Axes below each other with a common time, the band of states last."""
    if isinstance(sheet, Figure):
        sheet.set_figheight((PANEL * len(labels) + AROUND) * MM)
    heights = [1.0] * len(labels) + [BAND * len(labels) / size(sheet)[1]]
    axes: npt.NDArray[Any] = sheet.subplots(
        len(heights), 1, sharex=True, height_ratios=heights, squeeze=False
    )[:, 0]
    for here, label in zip(axes, labels):
        here.set(ylabel=label)
        here.grid(color="#e1e1e1", linewidth=0.5)
        here.set_axisbelow(True)
        for i in part.at or ():
            here.axvline(part.t[i], color=FAINT, linewidth=0.8, linestyle=":")
    _band(part, axes[-1], sheet)
    for here in axes:
        plain(here)
    sheet.align_ylabels(axes[:-1])
    return axes


def forces(part: Part, sheet: Sheet) -> npt.NDArray[Any]:
    """For each touched surface and obstacle the normal force and the friction of its contacts, between the limits of sticking and
    slipping, and the force of the hand, over time."""
    named = ("surface", [surface[0] for surface in part.scene.surfaces]), ("obstacle", [of[0] for of in part.scene.obstacles])
    solids = [
        # Without a name, its name is its number.
        (f"{kind} {name}" if name.isdigit() else name, *friction, part.contacts[kind] == i)
        for (kind, names), frictions in zip(named, part.scene.frictions)
        for i, (name, friction) in enumerate(zip(names, frictions))
        if (part.contacts[kind] == i).any()
    ]
    axes = _over_time(part, sheet, [fill(f"{solid[0]} (N)", LETTERS) for solid in solids] + ["hand (N)"])
    for here, (_, static, dynamic, of) in zip(axes, solids):
        normal, friction = (
            np.bincount(part.index[of], part.contacts[name][of], len(part.t)) for name in ("normal", "friction")
        )
        for limit, style in ((static, (0, (4, 2))), (dynamic, (0, (1, 1)))):
            for sign in (-1.0, 1.0):
                here.plot(part.t, sign * limit * normal, color=LIMIT, linewidth=0.7, linestyle=style)
        here.plot(part.t, normal, color=NORMAL, linewidth=1.0)
        here.plot(part.t, friction, color=FRICTION, linewidth=1.0)
    hand = axes[-2]
    for color, force in zip((HAND_X, HAND_Y), part.frames["wrench"][:, :2].T):
        hand.plot(part.t, force, color=color, linewidth=1.0)
    of_hand = [entry(HAND_X, "hand $F_x$"), entry(HAND_Y, "hand $F_y$")]
    of_solids = [
        entry(NORMAL, "normal $N$"),
        entry(FRICTION, "friction $T$"),
        entry(LIMIT, r"$\pm\mu_s N$", linewidth=0.7, linestyle=(0, (4, 2))),
        entry(LIMIT, r"$\pm\mu_d N$", linewidth=0.7, linestyle=(0, (1, 1))),
    ]
    legend(axes[0], sheet, (of_solids if solids else []) + of_hand)
    return axes


def motion(part: Part, sheet: Sheet) -> npt.NDArray[Any]:
    """The hand and the body over time: x and y of the holding point, and the angle."""
    points = np.column_stack([part.holding_points(), part.frames["pose"][:, 2]])
    hand = np.column_stack([part.frames["hand"][:, :2], part.hand_angles()])
    name, scale = unit(float(np.nanmax(hand[:, :2], axis=0).max() - np.nanmin(hand[:, :2], axis=0).min()))
    axes = _over_time(part, sheet, [f"x ({name})", f"y ({name})", "angle (°)"])
    for i, factor in enumerate((scale, scale, np.degrees(1.0))):
        everywhere = np.full(len(part.t), i == 2) | part.held
        lines = (points, BODY, 1.6, everywhere), (hand, OPEN_HAND, 0.8, ~part.held), (hand, HAND, 0.8, part.held)
        for values, color, width, shown in lines:
            if shown.any():
                axes[i].plot(part.t, factor * np.where(shown, values[:, i], np.nan), color=color, linewidth=width)
        low, high = axes[i].get_ylim()
        # What does not move is not magnified to noise.
        least = 1e-3 * scale if i < 2 else 1.0
        if high - low < least:
            axes[i].set_ylim((low + high - least) / 2.0, (low + high + least) / 2.0)
    entries = [entry(HAND, "hand", linewidth=0.8), entry(BODY, "body", linewidth=1.6)]
    if not part.held.all():
        entries.append(entry(OPEN_HAND, "open hand", linewidth=0.8))
    legend(axes[0], sheet, entries)
    return axes
