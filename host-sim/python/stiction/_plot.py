"""Pictures of a run with matplotlib: the paths in the plane, the forces and the motion over time."""

from __future__ import annotations

import numpy as np


def _placed(vertices, pose):
    cos, sin = np.cos(pose[2]), np.sin(pose[2])
    x, y = np.asarray(vertices).T
    return pose[0] + cos * x - sin * y, pose[1] + sin * x + cos * y


def trajectory(run, axes):
    """The path of the hand, that of the body, and the body at a few times, between surfaces and obstacles."""
    hand, pose = run.frames["hand"], run.frames["pose"]
    axes.plot(hand[:, 0], hand[:, 1], color="tab:gray", linewidth=1, label="hand")
    axes.plot(pose[:, 0], pose[:, 1], color="tab:blue", linewidth=1, label="body")
    for i in np.linspace(0, len(run) - 1, min(8, len(run))).astype(int):
        x, y = _placed(run.scene.vertices, pose[i])
        axes.fill(x, y, facecolor="none", edgecolor="tab:blue", alpha=0.5)
    for _, normal, offset in run.scene.surfaces:
        foot = offset * np.asarray(normal)
        axes.axline(foot, foot + [-normal[1], normal[0]], color="black", linewidth=1)
    for _, corners in run.scene.obstacles:
        x, y = np.asarray(corners).T
        axes.fill(x, y, facecolor="lightgray", edgecolor="black")
    axes.set(xlabel="x (m)", ylabel="y (m)", aspect="equal")
    axes.legend()


def forces(run, axes):
    """Normal force and friction of all contacts together, and the hand's force, over time."""
    t = run.frames["t"]
    for name, label in (("normal", "normal forces"), ("friction", "friction")):
        total = np.zeros(len(run))
        np.add.at(total, run.contacts["frame"], run.contacts[name])
        axes.plot(t, total, linewidth=1, label=label)
    axes.plot(t, np.hypot(*run.frames["wrench"][:, :2].T), linewidth=1, label="hand")
    axes.set(xlabel="t (s)", ylabel="force (N)")
    axes.legend()


def motion(run, axes):
    """Hand and body over time: x, y and angle."""
    t = run.frames["t"]
    for i, (name, unit) in enumerate((("x", "m"), ("y", "m"), ("angle", "rad"))):
        axes[i].plot(t, run.frames["hand"][:, i], color="tab:gray", linewidth=1, label="hand")
        axes[i].plot(t, run.frames["pose"][:, i], color="tab:blue", linewidth=1, label="body")
        axes[i].set(ylabel=f"{name} ({unit})")
    axes[0].legend()
    axes[-1].set(xlabel="t (s)")


def figure(run):
    """All of them in one figure."""
    from matplotlib.figure import Figure

    made = Figure(figsize=(10, 7), layout="constrained")
    left, right = made.subfigures(1, 2)
    upper, lower = left.subplots(2, 1)
    trajectory(run, upper)
    forces(run, lower)
    motion(run, right.subplots(3, 1, sharex=True))
    return made
