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
from ._solver import Frame, Solver
from ._stiction import __version__
from ._tables import CONTACT, EVENT, EVENTS, FRAME, STATES, STATUSES

__all__ = [
    "CONTACT",
    "EVENT",
    "EVENTS",
    "FRAME",
    "STATES",
    "STATUSES",
    "Frame",
    "Report",
    "Run",
    "Scene",
    "Solver",
    "__version__",
]
