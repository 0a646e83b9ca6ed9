"""Pictures in the plane, to scale: the paths of hand and body, and snapshots."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection

from ._part import Floats, Part
from ._sheet import BODY, BODY_THEN, FRICTION, HAND, HAND_X, INK, NORMAL, OPEN_HAND, SMALL, SOLID
from ._sheet import Sheet, entry, legend, legend_style, plain, size, unit
from ._tables import STATES

#: Height of the plane over its width, the least and the most: of a trajectory, and of a snapshot.
PLANE, FRAME = (0.4, 1.2), (0.6, 1.2)
#: The number of snapshots in a strip, and the least width of one (mm).
SNAPSHOTS, SNAPSHOT = 6, 24.0
#: The largest side of a snapshot over the size of body, hand and spring: if the run needs more, each snapshot follows the body.
LARGEST = 3.0
#: The longest arrow of a force over the size of body, hand and spring.
ARROW = 0.5


def _surroundings(part: Part, axes: Axes, window: Floats, scale: float) -> None:
    """What is solid in a window, low and high x and y (m); the limits of the axes are the window."""
    lines: dict[str, list[Floats]] = {"border": [], "hatch": [], "wall": []}
    for role, points in part.scene.shapes(tuple(window[0]), tuple(window[1])):
        shape = scale * np.asarray(points)
        if role in ("surface", "obstacle"):
            axes.fill(*shape.T, facecolor=SOLID, zorder=0)
        elif role == "pin":
            axes.plot(*shape.T, color=INK, marker=".", zorder=1)
        else:
            lines[role].append(shape)
    for role, width in (("border", 0.8), ("hatch", 0.3), ("wall", 1.5)):
        axes.add_collection(LineCollection(lines[role], colors=INK, linewidths=width, zorder=1))
    axes.set(xlim=scale * window[0], ylim=scale * window[1], aspect="equal")


def _window(points: Floats, ratios: tuple[float, float]) -> Floats:
    """Low and high x and y (m) around points, with a margin; the height over the width is in a range."""
    low, high = np.nanmin(points, axis=0), np.nanmax(points, axis=0)
    width, height = np.maximum(1.12 * (high - low), 1e-9)
    width, height = max(width, height / ratios[1]), max(height, ratios[0] * width)
    half = np.array([width, height]) / 2.0
    return np.column_stack([(low + high) / 2.0 - half, (low + high) / 2.0 + half])


def _extent(points: Floats) -> float:
    """The larger of width and height of some points (m)."""
    return float((np.nanmax(points, axis=0) - np.nanmin(points, axis=0)).max())


def _fill(axes: Axes, shape: Floats, color: str, **style: Any) -> None:
    """A body: a polygon, a rod or a point."""
    if len(shape) == 1:
        axes.plot(*shape.T, color=color, marker="o", markersize=3)
    else:
        axes.fill(*shape.T, edgecolor=color, linewidth=1.0, **style)


def _head(axes: Axes, tail: Floats, head: Floats, color: str, width: float) -> None:
    """An arrow."""
    style = {"arrowstyle": "-|>", "color": color, "linewidth": width, "mutation_scale": 7.0}
    axes.annotate("", tuple(head), tuple(tail), arrowprops={**style, "shrinkA": 0.0, "shrinkB": 0.0}, zorder=4)


def _direction(axes: Axes, path: Floats, color: str) -> None:
    """Arrowheads in the middle of each half of a path, by length."""
    path = path[np.isfinite(path).all(axis=1)]
    lengths = np.r_[0.0, np.cumsum(np.hypot(*np.diff(path, axis=0).T))]
    if lengths[-1] > 0.0:
        for middle in (0.25, 0.75):
            ends = [middle - 0.01, middle + 0.01]
            tail, head = np.column_stack([np.interp(np.multiply(ends, lengths[-1]), lengths, of) for of in path.T])
            _head(axes, tail, head, color, 0.0)


def _bodies(part: Part) -> list[Floats]:
    """The bodies of a trajectory."""
    return [part.body(i) for i in ([0, len(part.t) - 1] if part.at is None else part.at)]


def _plane(part: Part) -> Floats:
    """The window of a trajectory."""
    paths = part.frames["hand"][:, :2], part.holding_points(), part.contacts["point"]
    return _window(np.concatenate([*paths, *_bodies(part)]), PLANE)


def trajectory(part: Part, sheet: Sheet) -> npt.NDArray[Any]:
    """The paths of the hand and of the holding point to scale, and the body at its start and end, or at the chosen instants."""
    axes = sheet.subplots()
    hand, held, points = part.frames["hand"][:, :2], part.held, part.holding_points()
    touched, bodies, window = part.contacts["point"], _bodies(part), _plane(part)
    name, scale = unit(_extent(window.T))
    _surroundings(part, axes, window, scale)
    for body in bodies[:-1]:
        _fill(axes, scale * body, BODY_THEN, facecolor="none")
    _fill(axes, scale * bodies[-1], BODY, facecolor=BODY + "22")
    # One dot where many would be drawn over each other.
    cells = np.unique(np.round(touched / (window[0, 1] - window[0, 0]) * 200.0), axis=0, return_index=True)[1]
    axes.plot(*scale * touched[cells].T, color=FRICTION, marker=".", markersize=3, linestyle="", zorder=3)
    for path, color, width in ((points, BODY, 1.6), (hand, OPEN_HAND, 0.8), (hand, HAND, 0.8)):
        shown = ~held if color == OPEN_HAND else held
        if shown.any():
            axes.plot(*scale * np.where(shown[:, None], path, np.nan).T, color=color, linewidth=width)
    _direction(axes, scale * hand, HAND)
    axes.plot(*scale * hand[0], color=HAND, marker="o", markersize=4, markerfacecolor="white")
    axes.plot(*scale * hand[-1], color=HAND, marker="o", markersize=4)
    entries = [
        entry(HAND, "hand", linewidth=0.8),
        entry(BODY, "holding point", linewidth=1.6),
        entry(BODY, "body at end" if part.at is None else "body", marker="s", linewidth=0, markerfacecolor=BODY + "22"),
    ]
    if part.at is None:
        entries.append(entry(BODY_THEN, "body at start", marker="s", linewidth=0, markerfacecolor="none"))
    if len(touched):
        entries.append(entry(FRICTION, "contacts", marker=".", linewidth=0))
    if not held.all():
        entries.append(entry(OPEN_HAND, "open hand", linewidth=0.8))
    legend(axes, sheet, entries)
    axes.set(xlabel=f"x ({name})", ylabel=f"y ({name})")
    plain(axes)
    return np.array([axes])


def instants(part: Part, count: int) -> list[int]:
    """Frames for snapshots, in order: the ends, the first of each state, the longest slip, and others far from these in time."""
    state = part.frames["state"]
    firsts = np.unique(state, return_index=True)[1]
    longest = int(np.nanargmax(np.r_[0.0, part.frames["longest_slip"]])) - 1
    chosen: list[int] = []
    for candidates in ([0, len(state) - 1], firsts, [longest] if longest >= 0 else [], range(len(state))):
        left = np.asarray(candidates, np.intp)
        while len(chosen) < count and len(left):
            far = np.min([np.abs(part.t[left] - part.t[i]) for i in chosen], axis=0) if chosen else left
            best = int(np.argmax(far))
            if chosen and far[best] <= 0.0:
                break
            chosen.append(int(left[best]))
    return sorted(chosen)


class Snapshot:
    """What is drawn of a frame: the body, the hand, and the forces on the body as arrows."""

    def __init__(self, part: Part, frame: int) -> None:
        self.body = part.body(frame)
        self.hand: Floats = part.frames["hand"][frame, :2]
        self.held = bool(part.held[frame])
        self.point: Floats = part.holding_points()[frame]
        self.title = f"{part.t[frame]:.3g} s\n{STATES[part.frames['state'][frame]]}"
        #: Feet (m), forces (N) and colors.
        self.forces: list[tuple[Floats, Floats, str]] = []
        if self.held:
            self.forces.append((self.point, part.frames["wrench"][frame, :2], HAND_X))
        contacts = part.of_frame(frame)
        for contact, n in zip(contacts, part.normals(contacts)):
            along = np.array([n[1], -n[0]])
            self.forces.append((contact["point"], contact["normal"] * n, NORMAL))
            self.forces.append((contact["point"], contact["friction"] * along, FRICTION))

    def points(self, per_newton: float = 0.0) -> Floats:
        """What has to be seen (m), with arrows of a length (m/N)."""
        tips = [foot + per_newton * force for foot, force, _ in self.forces]
        return np.vstack([self.body, self.hand, *tips])


def strip(part: Part, sheet: Sheet) -> npt.NDArray[Any]:
    """Snapshots at chosen instants, to one scale: the body, the hand, and the forces on the body."""
    shown = [Snapshot(part, i) for i in (instants(part, SNAPSHOTS) if part.at is None else part.at)]
    largest = max(_extent(one.points()) for one in shown) or 1.0
    strongest = max((float(np.hypot(*force)) for one in shown for _, force, _ in one.forces), default=0.0)
    per_newton = ARROW * largest / strongest if strongest > 0.0 else 0.0
    windows = [_window(np.vstack([one.points(per_newton) for one in shown]), FRAME)] * len(shown)
    if _extent(windows[0].T) > LARGEST * largest:
        each = [_window(one.points(per_newton), FRAME) for one in shown]
        half = np.max([np.ptp(window, axis=1) for window in each], axis=0)[:, None] * np.array([-0.5, 0.5])
        windows = [window.mean(axis=1, keepdims=True) + half for window in each]
    columns = min(len(shown), max(1, int(size(sheet)[0] / SNAPSHOT)))
    grid: npt.NDArray[Any] = sheet.subplots(-(-len(shown) // columns), columns, squeeze=False)
    for axes, one, window in zip(grid.flat, shown, windows):
        _snapshot(part, one, axes, window, per_newton)
    for axes in grid.flat[len(shown) :]:
        axes.remove()
    used = {color for one in shown for _, _, color in one.forces}
    arrows = ((NORMAL, "normal force"), (FRICTION, "friction"), (HAND_X, "hand"))
    entries = [entry(color, label) for color, label in arrows if color in used]
    if entries:
        sheet.legend(**legend_style(sheet, entries), loc="outside upper left")
    drawn: npt.NDArray[Any] = grid.ravel()[: len(shown)]
    return drawn


def _snapshot(part: Part, one: Snapshot, axes: Axes, window: Floats, per_newton: float) -> None:
    """Draws a snapshot in a window (m), with arrows of a length (m/N)."""
    scale = unit(_extent(window.T))[1]
    _surroundings(part, axes, window, scale)
    _fill(axes, scale * one.body, BODY, facecolor=BODY + "22")
    if one.held:
        axes.plot(*scale * np.vstack([one.point, one.hand]).T, color=HAND, linewidth=0.8)
    axes.plot(*scale * one.hand, color=HAND if one.held else OPEN_HAND, marker="o", markersize=3.5, markerfacecolor="white")
    for foot, force, color in one.forces:
        arrow = per_newton * force
        if np.hypot(*arrow) > 0.01 * np.ptp(window):
            _head(axes, scale * foot, scale * (foot + arrow), color, 1.0)
    plain(axes)
    for spine in axes.spines.values():
        spine.set(visible=True, color="#cccccc")
    axes.set(xticks=[], yticks=[])
    axes.set_title(one.title, fontsize=SMALL)
