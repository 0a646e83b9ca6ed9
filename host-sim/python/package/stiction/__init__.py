"""Contact of an object held in the hand, with true stick-slip, by statics alone.

SI units; the world frame is right-handed with y upwards, angles are in radians, counter-clockwise and unwrapped; forces are those on the
body.

>>> import stiction
>>> scene = stiction.Scene.bundled("box-flat")
>>> run = stiction.Solver(scene).run(scene.hand_array())
>>> run.judge().lawful
True
"""

from ._run import Report, Run
from ._scene import Scene
from ._solver import Solver
from ._stiction import Frame, __version__
from ._tables import CONTACT, EVENT, EVENTS, FRAME, STATES, STATUSES
from ._types import EventName, Evolution, Number, Obstacle, Picture, StateName, StatusName, Surface

__all__ = [
    "CONTACT",
    "EVENT",
    "EVENTS",
    "FRAME",
    "STATES",
    "STATUSES",
    "EventName",
    "Evolution",
    "Frame",
    "Number",
    "Obstacle",
    "Picture",
    "Report",
    "Run",
    "Scene",
    "Solver",
    "StateName",
    "StatusName",
    "Surface",
    "__version__",
]
