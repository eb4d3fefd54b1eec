"""Plan regrasps and validate them: grasps, plans and reports as Python objects.

A hand holds an object with its fingertips and changes its grasp without letting go. `plan` finds
the sequence of steps, `validate` checks it and replays it in a physics engine, and `force_closure`
evaluates one grasp or a million. `validate_grasps` tests grasps by a whole hand, with all links.

Lengths are in the object's unit; `Object.scale` is its size in metres. Angles are in degrees, and
their names end in `_deg`. Errors are exceptions with the one-line text that the programs print.
`InputError` (a `ValueError`) is raised for an invalid file or argument, `NoPlan` if no plan is
found, and `OSError` if the machine fails.

>>> import regrasp
>>> cube = regrasp.Object.read("models/cube.obj")
>>> cube
<Object cube.obj: 6 faces, 10.4 cm across, 216 g at the density of water>
>>> plan = regrasp.plan(cube, "models/cube.start.json", "models/cube.goal.json",
...                     friction_angle_deg=20)
>>> report = regrasp.validate(cube, plan)
>>> report.passed
True
"""

from ._regrasp import InputError
from ._regrasp import version as __version__
from .grasps import ForceClosure, force_closure
from .hand_grasps import GraspVerdicts, validate_grasps
from .hands import Hand
from .objects import Object
from .plans import NoPlan, Plan, plan, plan_in_hand
from .reports import Report, Trajectory, validate

InputError.__module__ = __name__

__all__ = [
    "ForceClosure",
    "GraspVerdicts",
    "Hand",
    "InputError",
    "NoPlan",
    "Object",
    "Plan",
    "Report",
    "Trajectory",
    "force_closure",
    "plan",
    "plan_in_hand",
    "validate",
    "validate_grasps",
]
