"""Scenes, from files or from values."""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _stiction, _toml
from ._types import Obstacle, Surface


class Scene:
    """A body, the springs that hold it, and what it may touch. It is immutable.

    Args:
        vertices: of the body (m), counter-clockwise, in the body frame, (N, 2): one is a point, two are a rod.
        translation: stiffness of the springs against displacement, k_h (N/m), above 0.
        rotation: stiffness of the spring against rotation, k_theta (N m/rad), 0 or more.
        start: x, y (m) and theta (rad) of the body before the first sample of a hand.
        weight: at the centroid, along world -y (N); None: 0.
        holding_point: where the hand holds the body (m, body frame); None: where it grasps.
        reach: how far outside the body a hand may be and still grasp (m); None: 0.
        surfaces: half-planes, dictionaries as `Surface` describes them.
        obstacles: what has corners, dictionaries as `Obstacle` describes them.

    Raises:
        ValueError: a value is unusable, or no solver takes the scene; the message names the value and what is allowed.
    """

    _scene: _stiction.Scene

    def __init__(
        self,
        *,
        vertices: npt.ArrayLike,
        translation: float,
        rotation: float = 0.0,
        start: npt.ArrayLike = (0.0, 0.0, 0.0),
        weight: float | None = None,
        holding_point: npt.ArrayLike | None = None,
        reach: float | None = None,
        surfaces: Iterable[Surface] = (),
        obstacles: Iterable[Obstacle] = (),
    ) -> None:
        text = _toml.scene(
            {"vertices": vertices, "start": start, "weight": weight},
            {"point": holding_point, "reach": reach},
            {"translation": translation, "rotation": rotation},
            surfaces,
            obstacles,
        )
        self._scene = _stiction.Scene.from_text(text, "scene")

    @classmethod
    def _of(cls, scene: _stiction.Scene) -> Scene:
        made = cls.__new__(cls)
        made._scene = scene
        return made

    @classmethod
    def from_toml(cls, path: str | os.PathLike[str]) -> Scene:
        """A scene file. Unusable input raises a ValueError that names file, line and key."""
        return cls._of(_stiction.Scene.from_toml(path))

    @classmethod
    def from_text(cls, text: str, name: str = "scene.toml") -> Scene:
        """A scene from the text of a scene file; `name` is the file's name in messages."""
        return cls._of(_stiction.Scene.from_text(text, name))

    @classmethod
    def bundled(cls, name: str) -> Scene:
        """A bundled scene, for example "box-flat"; an unknown name raises a ValueError that lists them."""
        return cls._of(_stiction.Scene.bundled(name))

    @property
    def text(self) -> str:
        """The text of its file (TOML)."""
        return self._scene.text

    @property
    def vertices(self) -> npt.NDArray[np.float64]:
        """Vertices of the body (m), body frame, counter-clockwise: (N, 2)."""
        return np.asarray(self._scene.vertices)

    @property
    def surfaces(self) -> list[tuple[str, tuple[float, float], float]]:
        """Name, unit normal (world frame) and offset (m) of each surface."""
        return self._scene.surfaces

    @property
    def obstacles(self) -> list[tuple[str, list[tuple[float, float]]]]:
        """Name and corners (m, world frame) of each obstacle."""
        return self._scene.obstacles

    @property
    def stiffness(self) -> tuple[float, float]:
        """Stiffness of the springs: k_h (N/m), k_theta (N m/rad)."""
        return self._scene.stiffness

    def hand_array(self, rate: float | None = None) -> npt.NDArray[np.float64]:
        """The path of the hand in the scene file: (N, 3) x, y (m), phi (rad), world frame.

        rate: samples per second (Hz); None: that of the scene. A scene without a path raises a ValueError.
        """
        return np.ascontiguousarray(self._scene.hand(None, rate)[:, 1:4])

    def recorded(
        self,
        path: str | os.PathLike[str] | None = None,
        rate: float | None = None,
        fit: bool = False,
    ) -> dict[str, npt.NDArray[Any]]:
        """A recorded hand (csv, tum, txt), placed as in the scene's [hand], for `Solver.run(**scene.recorded(path))`.

        path: the file; None: the path of the scene file. rate: samples per second (Hz); None: those of the recording, or that of the scene.
        fit: place it over the scene, as `stiction run --fit` does: unit, angle, plane and origin.
        Returns `hand`, (N, 3) x, y (m), phi (rad); `t` (s); `held`. An unusable file raises a ValueError; what is skipped or looks
        wrong, as a path in millimetres, is a UserWarning that names the key which mends it.
        """
        samples = self._scene.hand(path, rate, fit)
        return {
            "hand": np.ascontiguousarray(samples[:, 1:4]),
            "t": np.ascontiguousarray(samples[:, 0]),
            "held": samples[:, 4] != 0.0,
        }

    def __reduce__(self) -> tuple[Any, ...]:
        return (Scene.from_text, (self.text, self._scene.name))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Scene) and self.text == other.text

    def __hash__(self) -> int:
        return hash(self.text)

    def __repr__(self) -> str:
        return repr(self._scene)
