"""Reports: what the analytic check and the replay say of a plan."""

from __future__ import annotations

import json

from . import _arguments, _regrasp
from ._regrasp import InputError
from .objects import Object
from .plans import Plan


class Report:
    """What `validate` says: `data` is report.json as a dict (docs/report.schema.json)."""

    def __init__(self, text: str, table: str, failure: str | None):
        self.text = text
        self.data: dict = json.loads(text)
        self.table = table
        """For people: a line for each step, what is weakest, the verdict."""
        self.failure = failure
        """What failed, why and what would mend it, in one line; None where the plan passes."""

    @property
    def passed(self) -> bool:
        """The verdict."""
        return self.failure is None

    @property
    def steps(self) -> list[dict]:
        """What is said of the hold and of each step after it."""
        return self.data["steps"]

    def __str__(self) -> str:
        return self.table

    def __repr__(self) -> str:
        verdict = "pass" if self.passed else self.failure
        return f"<Report of {self.data['plan']['file']}: {verdict}>"


def validate(object: Object, plan: Plan, mu: float | None = None, *,
             friction_angle_deg: float | None = None, mass: float | None = None,
             squeeze: float | None = None, shake: float = 0.01, tolerance: float = 0.001,
             stress: bool = False, progress=None) -> Report:
    """Checks a plan analytically, replays it with frictional point fingers, and disturbs the object.

    Args:
        object: that the plan was made for.
        plan: from `regrasp.plan` or `Plan.read`.
        mu: friction coefficient instead of the plan's, or
        friction_angle_deg: the half-angle of the cones in degrees.
        mass: of the object, kg; None: of water.
        squeeze: total normal force of a grasp, N; None: ten times what the shake needs.
        shake: force of the disturbance over the squeeze.
        tolerance: allowed motion and slip over the object's diameter.
        stress: also finds the largest push that each grasp bears in each direction.
        progress: called with a line of text after each step.

    Returns:
        The report; a plan that fails is no exception.

    Raises:
        InputError: the plan is for another object, or an argument is wrong.

    >>> cube = Object.read("models/cube.obj")
    >>> from regrasp import plan
    >>> found = plan(cube, "models/cube.start.json", "models/cube.goal.json", mu=0.4)
    >>> validate(cube, found).passed
    True
    >>> validate(cube, found, mu=0.05).steps[0]["reason"]
    'not-force-closure'
    """
    if not isinstance(object, Object):
        raise InputError(f"object: an Object is needed, found {type(object).__name__}")
    if not isinstance(plan, Plan):
        raise InputError(f"plan: a Plan is needed, found {type(plan).__name__}; "
                         "Plan.read reads a file")
    given = _regrasp.ValidateArguments()
    given.half_angle = _arguments.half_angle(mu, friction_angle_deg)
    if mass is not None:
        given.mass_kg = _arguments.number("mass", mass, 0)
    if squeeze is not None:
        given.squeeze_N = _arguments.number("squeeze", squeeze, 0)
    given.shake = _arguments.number("shake", shake, 0)
    given.tolerance = _arguments.number("tolerance", tolerance, 0)
    given.stress = bool(stress)
    return Report(*_regrasp.validate_plan(object._core, plan.text, plan.name, given, progress))
