"""Pictures of a run with matplotlib: paths in the plane, forces, motion, and a strip of snapshots."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from ._run import Run

#: The number of snapshots in a strip.
SNAPSHOTS = 5


def _placed(run: Run, pose: npt.NDArray[np.float64]) -> Any:
    x, y, theta = pose
    return np.asarray(run.scene._scene.placed((x, y, theta))).T


def _instants(run: Run, count: int) -> npt.NDArray[np.intp]:
    return np.linspace(0, len(run) - 1, min(count, len(run))).astype(np.intp)


def surroundings(run: Run, axes: Axes) -> None:
    """Surfaces and obstacles, as far as they are seen between the limits of the axes."""
    x, y = axes.get_xlim(), axes.get_ylim()
    for role, points in run.scene._scene.shapes(x, y):
        shape = np.asarray(points).T
        if role == "obstacle":
            axes.fill(*shape, facecolor="lightgray")
        elif role in ("border", "wall"):
            axes.plot(*shape, color="black", linewidth=1)
        elif role == "pin":
            axes.plot(*shape, color="black", marker=".")
    axes.set(xlim=x, ylim=y)


def trajectory(run: Run, axes: Axes) -> None:
    """The paths of the hand and of the body, and the body at a few times, among surfaces and obstacles."""
    hand, pose = run.frames["hand"], run.frames["pose"]
    axes.plot(hand[:, 0], hand[:, 1], color="tab:gray", linewidth=1, label="hand")
    axes.plot(pose[:, 0], pose[:, 1], color="tab:blue", linewidth=1, label="body")
    for i in _instants(run, 8):
        x, y = _placed(run, pose[i])
        axes.fill(x, y, facecolor="none", edgecolor="tab:blue", alpha=0.5)
    for _, corners in run.scene.obstacles:
        axes.update_datalim(corners)
    axes.autoscale_view()
    surroundings(run, axes)
    axes.set(xlabel="x (m)", ylabel="y (m)", aspect="equal")
    axes.legend()


def forces(run: Run, axes: Axes) -> None:
    """Total normal force and friction of all contacts, and the hand's force, over time."""
    t, contacts = run.frames["t"], run.contacts
    for name, label in (("normal", "normal forces"), ("friction", "friction")):
        total = np.bincount(contacts["frame"], weights=contacts[name], minlength=len(run))
        axes.plot(t, total, linewidth=1, label=label)
    axes.plot(t, np.hypot(*run.wrench[:, :2].T), linewidth=1, label="hand")
    axes.set(xlabel="t (s)", ylabel="force (N)")
    axes.legend()


def motion(run: Run, axes: npt.NDArray[Any]) -> None:
    """Hand and body over time: x, y and angle."""
    t = run.frames["t"]
    for i, (name, unit) in enumerate((("x", "m"), ("y", "m"), ("angle", "rad"))):
        axes[i].plot(t, run.frames["hand"][:, i], color="tab:gray", linewidth=1, label="hand")
        axes[i].plot(t, run.frames["pose"][:, i], color="tab:blue", linewidth=1, label="body")
        axes[i].set(ylabel=f"{name} ({unit})")
    axes[0].legend()
    axes[-1].set(xlabel="t (s)")


def strip(run: Run, axes: npt.NDArray[Any]) -> None:
    """The body at a few times, side by side, with the hand."""
    reach = 2.0 * np.abs(run.scene.vertices).max() or 1.0
    for here, i in zip(axes, _instants(run, SNAPSHOTS)):
        frame = run.frames[i]
        here.fill(*_placed(run, frame["pose"]), facecolor="none", edgecolor="tab:blue")
        here.plot(*frame["hand"][:2], color="tab:gray", marker="+")
        x, y, _ = frame["pose"]
        here.set(title=f"{frame['t']:.3g} s", aspect="equal", xticks=[], yticks=[])
        here.set(xlim=(x - reach, x + reach), ylim=(y - reach, y + reach))
        surroundings(run, here)


def figure(run: Run) -> Figure:
    """All pictures in one figure."""
    from matplotlib.figure import Figure

    if len(run) == 0:
        raise ValueError("the run has no frames to plot")
    made = Figure(figsize=(10, 9), layout="constrained")
    # Typed as a single figure, whatever their number.
    halves: Any = made.subfigures(2, 1, height_ratios=(3, 1))
    left, right = halves[0].subfigures(1, 2)
    upper, lower = left.subplots(2, 1)
    trajectory(run, upper)
    forces(run, lower)
    motion(run, right.subplots(3, 1, sharex=True))
    strip(run, halves[1].subplots(1, SNAPSHOTS))
    return made
