"""Reports: what the analytic check and the replay say of a plan."""

from __future__ import annotations

import json

import numpy as np

from . import _arguments, _html, _regrasp
from ._regrasp import InputError
from ._types import Progress
from .hands import Hand
from .objects import Object
from .plans import Plan


class Report:
    """What `validate` says: `data` is report.json as a dict (docs/report.schema.json).

    A notebook shows its contact sheet and its table.
    """

    def __init__(self, core: _regrasp.Report, object: Object):
        if not isinstance(core, _regrasp.Report):
            raise TypeError("use regrasp.validate")
        self._core = core
        self._object = object
        self._drawn: dict[tuple[int, int], tuple] = {}
        self.text: str = core.json
        """Of report.json."""
        self.data: dict = json.loads(self.text)
        self.table: str = core.table
        """For people: a line for each step, what is weakest, the verdict."""
        self.failure: str | None = core.failure
        """What failed, why and what would mend it, in one line; None where the plan passes."""

    @property
    def passed(self) -> bool:
        """The verdict."""
        return self.failure is None

    @property
    def steps(self) -> list[dict]:
        """What is said of the hold and of each step after it."""
        return self.data["steps"]

    def frames(self, size: tuple[int, int] = (1280, 960)) -> list[np.ndarray]:
        """The pictures of the hold and of each step up to the one that failed.

        Args:
            size: width and height, pixels.

        Returns:
            Arrays (height, width, 3) of uint8, RGB, rows from the top.
        """
        return self._draw(size)[0]

    def overview(self, size: tuple[int, int] = (1280, 960)) -> np.ndarray:
        """The contact sheet: all frames, small, with the verdict; (H, W, 3) of uint8.

        Args:
            size: of the frames, before they are made small.
        """
        return self._draw(size)[1]

    def _draw(self, size):
        try:
            width, height = size
        except (TypeError, ValueError):
            raise InputError("size: width and height are needed, found "
                             f"{_arguments.shown(size)}") from None
        limits = _regrasp.least_frame_side, _regrasp.most_frame_side
        size = (_arguments.integer("size[0]", width, *limits),
                _arguments.integer("size[1]", height, *limits))
        if size not in self._drawn:
            self._drawn[size] = self._core.draw(self._object._core, *size)
        return self._drawn[size]

    def _repr_png_(self) -> bytes:
        return _regrasp.encode_png(self.overview())

    def _repr_html_(self) -> str:
        return _html.picture(self._repr_png_(), repr(self)) + _html.text(self.table)

    def __str__(self) -> str:
        return self.table

    def __repr__(self) -> str:
        verdict = "pass" if self.passed else self.failure
        return f"<Report of {self.data['plan']['file']}: {verdict}>"


def validate(object: Object, plan: Plan, mu: float | None = None, *,
             friction_angle_deg: float | None = None, torsion: float | None = None,
             mass: float | None = None, squeeze: float | None = None, shake: float = 0.01,
             tolerance: float = 0.001, engine: str | None = None, stress: bool = False,
             hand: Hand | None = None, replay: str | None = None, tip: str | None = None,
             tolerance_mm: float = 2, tolerance_deg: float = 5, feedback: bool = True,
             progress: Progress = None) -> Report:
    """Checks a plan analytically, replays it with frictional point fingers or by a hand, and disturbs
    the object.

    Args:
        object: that the plan was made for.
        plan: from `regrasp.plan` or `Plan.read`.
        mu: friction coefficient instead of the plan's, or
        friction_angle_deg: the half-angle of the cones in degrees.
        torsion: of soft fingers instead of the plan's, in the object's unit; 0: hard points.
        mass: of the object, kg; None: of water.
        squeeze: total normal force of a grasp, N; None: ten times what the shake needs.
        shake: force of the disturbance over the squeeze.
        tolerance: allowed motion and slip over the object's diameter.
        engine: of the replay by points, "mujoco", "ode" (the Open Dynamics Engine), or "both": MuJoCo
            decides, and every step on which they differ is named; None: "mujoco".
        stress: also finds the largest push that each grasp bears in each direction.
        hand: of a plan for a hand: also checks its joints, limits, fingertips and collisions; frames
            show it.
        replay: "points", by ideal fingers, or "hand", on the hand's own model with its motors; None:
            by the hand where there is one.
        tip: what of a fingertip touches the object in a replay by the hand: "ball", that of the hand's
            file, for which plans are made, or "geometry", what the hand's model has there for
            collisions; None: "ball".
        tolerance_mm: how far the object may be from its planned place in a replay by the hand.
        tolerance_deg: how far it may be turned from it.
        feedback: of a replay by the hand: joint targets follow the object's measured pose.
        progress: called with a line of text after each step.

    Returns:
        The report; a plan that fails is no exception.

    Raises:
        InputError: the plan is for another object, or an argument is wrong.

    >>> cube = Object.read("models/cube.obj")
    >>> from regrasp import plan
    >>> found = plan(cube, "models/cube.start.json", "models/cube.goal.json", mu=0.4)
    >>> report = validate(cube, found)
    >>> report.passed
    True
    >>> [frame.shape for frame in report.frames((320, 240))]
    [(240, 320, 3), (240, 320, 3), (240, 320, 3)]
    >>> validate(cube, found, mu=0.05).steps[0]["reason"]
    'not-force-closure'
    >>> both = validate(cube, found, engine="both")
    >>> both.data["settings"]["engine"], both.steps[1]["engines"]["cause"]
    ('both', None)
    """
    _arguments.of_type("object", object, Object)
    _arguments.of_type("plan", plan, Plan, "; Plan.read reads a file")
    given = _regrasp.ValidationOptions()
    given.half_angle = _arguments.half_angle(mu, friction_angle_deg)
    if torsion is not None:
        given.torsion = _arguments.number("torsion", torsion, 0, zero=True)
    if mass is not None:
        given.mass_kg = _arguments.number("mass", mass, 0)
    if squeeze is not None:
        given.squeeze_N = _arguments.number("squeeze", squeeze, 0)
    given.shake = _arguments.number("shake", shake, 0, zero=True)
    given.tolerance = _arguments.number("tolerance", tolerance, 0)
    if engine is not None:
        given.set_engine(_arguments.choice("engine", engine, list(_regrasp.engines)))
    given.stress = _arguments.flag("stress", stress)
    if hand is not None:
        _arguments.of_type("hand", hand, Hand, "; Hand.read reads one")
    if hand is not None and "hand" not in plan.data:
        raise InputError(f"hand: {plan.name} is a plan for fingers without a hand")
    if hand is not None and object.dimension != 3:
        raise InputError(f"object: {object.name} is a polygon; hands hold solids")
    if replay is None:
        replay = "points" if hand is None else "hand"
    given.replay_by_hand = _arguments.choice("replay", replay, ["points", "hand"]) == "hand"
    if given.replay_by_hand and hand is None:
        raise InputError("hand: is needed for a replay by it")
    if given.replay_by_hand and engine is not None:
        raise InputError('engine: goes with replay="points"')
    if given.replay_by_hand and given.stress:
        raise InputError('stress: goes with replay="points"')
    if tip is not None:
        if _arguments.choice("tip", tip, ["ball", "geometry"]) == "geometry":
            given.use_tip_geometry()
        if not given.replay_by_hand:
            raise InputError('tip: goes with replay="hand"')
    given.feedback = _arguments.flag("feedback", feedback)
    given.set_hand_tolerance(_arguments.number("tolerance_mm", tolerance_mm, 0),
                             _arguments.number("tolerance_deg", tolerance_deg, 0))
    return Report(_regrasp.validate_plan(object._core, plan.text, plan.name, given,
                                         hand._core if hand else None,
                                         _arguments.callback("progress", progress)), object)
