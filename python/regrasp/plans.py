"""Plans: sequences of finger switches, sliding steps and in-hand motions between two grasps."""

from __future__ import annotations

import html
import json
import math
import os
from collections.abc import Sequence

import numpy as np

from . import _arguments, _html, _regrasp
from ._regrasp import InputError
from ._types import ArrayLike, GivenGrasp, Progress
from .hands import Hand
from .objects import Object

_PLANNERS = ["auto", *_regrasp.planner_names()]
_RANDOM = ("random", "random-any")
_MOST_JOBS = 1024


class NoPlan(RuntimeError):
    """Raised if no plan is found; the text reports the search."""


class Plan:
    """A plan, as in its file; returned by `plan`, `plan_in_hand` and `Plan.read`.

    `text` is the content of the file, byte for byte as the program `plan` writes it. `data` is the
    same as a dict (docs/plan.schema.json). `warnings` and `notes` are lists of text from the planner.
    """

    def __init__(self, text: str, name: str = "plan.json"):
        """Args:
            text: content of a plan file.
            name: name of the plan in messages and reports.

        Raises:
            InputError: `text` is not a plan; the message names the element.
        """
        _regrasp.check_plan_text(_arguments.text("text", text), _arguments.text("name", name))
        self.text = text
        self.name = name
        self.data: dict = json.loads(text)
        self.object: Object | None = None
        """Object of the plan if it is known. `plan` sets it; set it after `Plan.read` to make a notebook
        display every step."""
        self.warnings: list[str] = []
        self.notes: list[str] = []

    @classmethod
    def read(cls, path: str | os.PathLike, *, object: Object | None = None) -> Plan:
        """Read a plan file.

        Args:
            path: path of the file.
            object: object of the plan, which becomes `Plan.object`.

        Raises:
            InputError: the file is not a plan.
            OSError: the file cannot be read.
        """
        path = _arguments.path("path", path)
        if object is not None:
            _arguments.of_type("object", object, Object)
        plan = cls(_text_of(path), os.path.basename(path))
        plan.object = object
        return plan

    def write(self, path: str | os.PathLike) -> None:
        """Write the plan file."""
        _regrasp.write_file(_arguments.path("path", path), self.text.encode())

    @property
    def steps(self) -> list[dict]:
        """The steps, as in the file."""
        return self.data["steps"]

    def figure(self, object: Object | None = None, *, width_mm: float = 174) -> str:
        """Draw all steps as a line drawing, like the program `figure`.

        Args:
            object: object of the plan; default: `Plan.object`.
            width_mm: width of the drawing, millimetres.

        Returns:
            The drawing, as SVG text.

        Raises:
            InputError: the object is unknown or is not that of the plan, or a step is invalid.

        >>> cube = Object.read("models/cube.obj")
        >>> plan(cube, "models/cube.start.json", "models/cube.goal.json", mu=0.4).figure()[:5]
        '<?xml'
        """
        object = self.object if object is None else object
        if object is None:
            raise InputError(f"object is required, because {self.name} does not contain "
                             f"{self.data['object']['file']}")
        return _regrasp.draw_plan(_arguments.of_type("object", object, Object)._core, self.text,
                                  self.name, _arguments.number("width_mm", width_mm, 20, 2000))

    def _repr_html_(self) -> str:
        rows = [["0", "hold", _fingers(self.data["initial"]["contacts"])]]
        for i, step in enumerate(self.steps, 1):
            rows.append([str(i), step["kind"], _describe(step)])
        page = f"<p>{html.escape(repr(self)[1:-1])}</p>" + _html.table(
            ["step", "kind", "what happens"], rows)
        if self.object is None:
            return page
        try:
            return page + _html.drawing(self.figure(), repr(self))
        except InputError as error:  # a step cannot be drawn, so only the table is shown
            return page + _html.text(str(error))

    def __len__(self) -> int:
        return len(self.steps)

    def __repr__(self) -> str:
        kinds = [step["kind"] for step in self.steps]
        several = {"switch": "switches", "align": "aligns", "move": "moves"}
        counts = [f"{kinds.count(kind)} {kind if kinds.count(kind) == 1 else several[kind]}"
                  for kind in several if kind in kinds]
        return f"<Plan of {self.data['object']['file']}: {', '.join(counts) or 'no steps'}>"


def _text_of(path: str) -> str:
    try:
        with open(path, encoding="utf-8") as file:
            return file.read()
    except UnicodeDecodeError as error:
        raise InputError(f"{path}: not valid UTF-8: {error}") from None


def _fingers(contacts: list[dict]) -> str:
    names = [str(contact["finger"]) for contact in contacts]
    return ("finger " if len(names) == 1 else "fingers ") + ", ".join(names)


def _describe(step: dict) -> str:
    if step["kind"] == "switch":
        released = [{"finger": finger} for finger in step["release"]]
        parts = [("place ", step["place"]), ("release ", released)]
        return "; ".join(what + _fingers(which) for what, which in parts if which)
    if step["kind"] == "align":
        first, last = (step["waypoints"][i]["contacts"] for i in (0, -1))
        where = {contact["finger"]: contact["point"] for contact in first}
        moved = [contact for contact in last if where.get(contact["finger"]) != contact["point"]]
        return f"move {_fingers(moved or last)} along the surface"
    return "the object moves in the hand"


def plan(object: Object, start: GivenGrasp, goal: GivenGrasp, mu: float | None = None, *,
         friction_angle_deg: float | None = None, planner: str = "auto", optimize: str = "steps",
         contacts: int | None = None, clusters: int | None = None, seed: int = 0,
         min_quality: float = 0.01, finger_radius: float = 0, torsion: float = 0,
         time_limit: float | None = None, progress: Progress = None) -> Plan:
    """Find a plan from one grasp to another with force closure at every instant.

    The same arguments give the same plan, bit for bit, unless `time_limit` ends the search. It is the
    plan that the program `plan` writes.

    Args:
        object: object to hold.
        start: start grasp. An array (k, 3) of points on the surface ((k, 2) for a polygon), a pair
            (points, normals), or the path of a grasp file. "random" draws it from the planner's own
            graph, "random-any" uniformly on the surface.
        goal: goal grasp, in the same forms.
        mu: friction coefficient; give either `mu` or `friction_angle_deg`.
        friction_angle_deg: friction angle, degrees.
        planner: "auto" or the name of a planner, as on the command line.
        optimize: objective: "steps", "margin" or "travel"; "regions" for polygons.
        contacts: number of contact points of the planner "roadmap"; default: chosen by the planner.
        clusters: number of clusters of these points; default: chosen by the planner.
        seed: seed of all random choices.
        min_quality: smallest grasp quality ε of random grasps; the plan prefers such grasps.
        finger_radius: radius of the fingers, in the object's unit; 0: points.
        torsion: torsional friction length of soft fingers, in the object's unit; 0: hard fingers.
        time_limit: longest time, seconds. A plan then depends on the speed of the machine.
        progress: function that is called with one line of text per stage.

    Returns:
        The plan, with `warnings` and `notes`.

    Raises:
        InputError: an argument is invalid, or a grasp is not on the object or not force closure.
        NoPlan: no plan is found. This does not prove that none exists.

    >>> cube = Object.read("models/cube.obj")
    >>> start = [[.03, .004, .002], [-.03, .002, -.004], [.003, .03, .004], [-.002, -.03, .001]]
    >>> found = plan(cube, start, "random", mu=0.5, seed=3)
    >>> found
    <Plan of cube.obj: 1 switch, 1 align>
    >>> found.steps[0]["kind"]
    'align'
    """
    _arguments.of_type("object", object, Object)
    given = _asked(mu, friction_angle_deg, seed, min_quality, time_limit)
    given.start = _grasp_text("start", start, object)
    given.goal = _grasp_text("goal", goal, object)
    given.planner = _arguments.choice("planner", planner, _PLANNERS)
    words = ["steps", "margin", "travel", "regions"]
    given.objective = getattr(_regrasp.Objective, _arguments.choice("optimize", optimize, words))
    if contacts is not None:
        given.contacts = _arguments.integer("contacts", contacts, _regrasp.fewest_clusters,
                                            _regrasp.most_contacts)
    if clusters is not None:
        given.clusters = _arguments.integer("clusters", clusters, _regrasp.fewest_clusters,
                                            _regrasp.most_clusters)
    given.finger_radius = _arguments.number("finger_radius", finger_radius, 0, zero=True)
    given.torsion = _arguments.number("torsion", torsion, 0, zero=True)
    return _plan_of(object, *_regrasp.find_plan(object._core, given,
                                                _arguments.callback("progress", progress)))


def plan_in_hand(object: Object, hand: Hand, mu: float | None = None, *,
                 friction_angle_deg: float | None = None, turn: tuple[str, float] | None = None,
                 start: GivenGrasp | dict | None = None, goal: GivenGrasp | dict | None = None,
                 start_pose: ArrayLike | None = None, goal_pose: ArrayLike | None = None,
                 goals: str | os.PathLike | Sequence[dict] | None = None,
                 gravity: str | ArrayLike | None = None, mass: float | None = None,
                 closure: str = "force", rolling: bool = False, optimize: str = "steps",
                 robustness: str = "required", clearance: float = 0.001, seed: int = 0,
                 min_quality: float = 0.01, time_limit: float | None = None,
                 jobs: int | None = None, progress: Progress = None) -> Plan:
    """Find how a hand rotates or moves an object, or changes its grasp.

    The plan has the joint angles of all fingers and is free of collisions. Set at least one of `turn`,
    `goal_pose`, `goals` and `goal`. The same arguments give the same plan, bit for bit, unless `time_limit`
    ends the search.

    Args:
        object: object to hold, a solid.
        hand: hand that moves it.
        mu: friction coefficient; give either `mu` or `friction_angle_deg`.
        friction_angle_deg: friction angle, degrees.
        turn: rotation, as a pair of an object axis ("x", "y" or "z") and an angle in degrees.
        start: start grasp of three contacts or more, in the forms of `plan`; default: any. A
            dictionary is a hand grasp (docs/format_hand_grasps.md): its object pose, fingertip
            contacts and joint angles are the start.
        goal: goal grasp, in the same forms. For a hand grasp, object pose and contacts are the goal.
        start_pose: initial pose of the object frame in the palm frame. Seven numbers: position in
            metres and unit quaternion w, x, y, z. Default: the pose at which the fingers reach most
            of the object.
        goal_pose: final pose, in the same form.
        goals: goals that the object reaches one after the other. Path of a goals file
            (docs/format_goals.md), or its list of goals as dictionaries. The plan marks the step of
            each goal.
        gravity: direction of gravity in the palm frame, three numbers. "any" tries the direction of the
            hand file and then the six axes. Default: the direction of the hand file.
        mass: mass of the object in simulation, kg. The plan records it, and `validate` uses it. Default:
            that of the density of water.
        closure: "force" for force closure. "gravity" also permits grasps that hold the object by its
            weight, with forces of up to 9 weights, against disturbances of 0.1 weights.
        rolling: whether fingertips roll without slipping in in-hand motions, instead of contacts that
            are fixed on the object. Cannot be used with `goal` or the closure "gravity".
        optimize: "steps", or "margin" for the plan that fails under the fewest standard conditions.
        robustness: robustness of the plan. "required" returns only a plan that executes in simulation on
            the hand's actuators. "preferred" returns a plan that does not, if none is found that does.
            "standard" returns only a plan that also executes with realistic sensors, joint errors of
            0.5° and 20 % less friction. "none" does not simulate.
        clearance: smallest distance of links to each other, palm and object, metres.
        seed: seed of all random choices.
        min_quality: grasp quality ε that the plan prefers.
        time_limit: longest time, seconds.
        jobs: number of parallel searches; default: one per processor. Without a time limit the plan
            does not depend on it.
        progress: function that is called with one line of text per stage, from any thread.

    Raises:
        InputError: an argument is invalid.
        NoPlan: no plan is found, or none that executes in simulation; the text names the failure.

    >>> ring = Hand.read("models/hands/ring4.json")
    >>> cube = Object.read("models/cube.obj")
    >>> plan_in_hand(cube, ring, mu=0.8, turn=("z", 30))
    <Plan of cube.obj: 1 move>
    """
    _arguments.of_type("object", object, Object)
    _arguments.of_type("hand", hand, Hand, "; Hand.read reads one")
    if object.dimension != 3:
        raise InputError(f"object must be a solid, found the polygon {object.name}")
    if turn is not None and goal_pose is not None:
        raise InputError("turn cannot be used with goal_pose")
    for name, value in (("turn", turn), ("goal_pose", goal_pose), ("goal", goal)):
        if goals is not None and value is not None:
            raise InputError(f"goals cannot be used with {name}")
    if turn is None and goal_pose is None and goals is None and goal is None:
        raise InputError('a goal is required: turn=("z", 90), goal_pose, goals or goal')
    _check_hand_grasps(start, goal, {"turn": turn, "goal_pose": goal_pose}, start_pose)
    if (turn is None and goal_pose is None and goals is None and start is None and start_pose is None
            and not isinstance(goal, dict)):
        raise InputError("goal requires start or start_pose")
    given = _asked(mu, friction_angle_deg, seed, min_quality, time_limit)
    if jobs is None:
        jobs = min(os.cpu_count() or 1, _MOST_JOBS)
    given.jobs = _arguments.integer("jobs", jobs, 1, _MOST_JOBS)
    task = _regrasp.HandArguments()
    if isinstance(start, dict):
        task.start_hand_grasp = json.dumps(start)
    elif start is not None:
        given.start = _grasp_text("start", start, object, random=False)
    if isinstance(goal, dict):
        task.goal_hand_grasp = json.dumps(goal)
    elif goal is not None:
        given.goal = _grasp_text("goal", goal, object, random=False)
    if turn is not None:
        task.turn_axis, task.turn_angle = _turn(turn)
    task.start_pose = None if start_pose is None else _pose("start_pose", start_pose)
    task.goal_pose = None if goal_pose is None else _pose("goal_pose", goal_pose)
    if goals is not None:
        task.goals_name, task.goals = _goals_text(goals)
    if gravity is not None:
        task.ups = _ups(gravity, hand)
    if mass is not None:
        task.mass_kg = _arguments.number("mass", mass, 0)
    task.rolls = _arguments.flag("rolling", rolling)
    for name, given_too in (("goal", goal is not None), ('closure="gravity"', closure == "gravity")):
        if task.rolls and given_too:
            raise InputError(f"rolling cannot be used with {name}")
    task.gravity_support = _arguments.choice("closure", closure, ["force", "gravity"]) == "gravity"
    given.objective = getattr(_regrasp.Objective, _arguments.choice("optimize", optimize, ["steps", "margin"]))
    words = ["preferred", "required", "standard", "none"]
    level = _arguments.choice("robustness", robustness, words)
    task.is_standard = level == "standard"
    task.robustness = getattr(_regrasp.RobustnessLevel, "required" if task.is_standard else level)
    task.clearance = _arguments.number("clearance", clearance, 0, math.nextafter(0.05, 1), zero=True)
    return _plan_of(object, *_regrasp.find_plan_in_hand(
        object._core, given, hand._core, task, _arguments.callback("progress", progress)))


def _check_hand_grasps(start, goal, moves: dict, start_pose) -> None:
    """Check that poses are not stated in addition to those of hand grasps."""
    if isinstance(start, dict) and start_pose is not None:
        raise InputError("start: a hand grasp states the pose, cannot be used with start_pose")
    for name, value in moves.items():
        if isinstance(goal, dict) and value is not None:
            raise InputError(f"goal: a hand grasp states the pose, cannot be used with {name}")


def _asked(mu, friction_angle_deg, seed, min_quality, time_limit):
    """Return the arguments that all planners share."""
    given = _regrasp.PlanArguments()
    given.half_angle = _arguments.needed_half_angle(mu, friction_angle_deg)
    given.seed = _arguments.integer("seed", seed, 0, 2**64 - 1)
    given.min_quality = _arguments.number("min_quality", min_quality, 0, zero=True)
    if time_limit is not None:
        given.time_limit_s = _arguments.number("time_limit", time_limit, 0)
    return given


def _goals_text(goals) -> tuple[str, str]:
    """Return the name and the text of a file of goals."""
    if isinstance(goals, (str, os.PathLike)):
        path = os.fspath(goals)
        try:
            with open(path, encoding="utf-8") as file:
                return path, file.read()
        except (OSError, UnicodeDecodeError):
            raise InputError(f"goals: cannot read {path}") from None
    try:
        text = json.dumps({"format": "regrasp-goals", "version": 1, "goals": list(goals)})
    except (TypeError, ValueError) as error:
        raise InputError(f"goals must be a path or a list of dictionaries: {error}") from None
    return "goals", text


def _turn(turn) -> tuple[list[float], float]:
    try:
        axis, degrees = turn
    except (TypeError, ValueError):
        raise InputError('turn must be an axis and degrees, for example ("z", 90), found '
                         f"{_arguments.shown(turn)}") from None
    axis = _arguments.choice("turn[0]", axis, ["x", "y", "z"])
    degrees = _arguments.number("turn[1]", degrees, math.nextafter(-3600, -math.inf), math.nextafter(3600, math.inf))
    if degrees == 0:
        raise InputError("turn[1] must not be 0 degrees")
    return [float(axis == other) for other in "xyz"], degrees * (math.pi / 180)


def _ups(gravity, hand: Hand) -> list[np.ndarray]:
    """Return the unit vectors against the directions of gravity, first choice first."""
    if isinstance(gravity, str):
        _arguments.choice("gravity", gravity, ["any"])
        return _regrasp.up_directions(hand._core)
    down = _arguments.vector("gravity", gravity, 3)
    length = np.linalg.norm(down)
    if length < 1e-9:
        raise InputError("gravity must not be a zero vector")
    return [-down / length]


def _pose(name: str, pose) -> list[float]:
    pose = _arguments.numbers(name, pose, "(7,)", (1,))
    if len(pose) != 7:
        raise InputError(f"{name} must have 7 numbers, position and quaternion, found {len(pose)}")
    length = math.hypot(*pose[3:])
    if abs(length - 1) > 1e-3:
        raise InputError(f"{name} must have a unit quaternion, found length {length:.4g}")
    distance = math.hypot(*pose[:3])
    if distance > 10:
        raise InputError(f"{name} must be within 10 m of the palm, found {distance:.4g} m")
    return pose.tolist()


def _plan_of(object: Object, text, message, warnings, notes) -> Plan:
    if text is None:
        raise NoPlan(message)
    result = Plan(text)
    result.object = object
    result.warnings = [warning for warning in warnings if warning]
    result.notes = notes
    return result


def _grasp_text(name: str, grasp, object: Object, random: bool = True) -> str:
    """Return a grasp argument as the text of a grasp file, or the word for a random grasp."""
    if isinstance(grasp, (str, bytes, os.PathLike)):
        if random and grasp in _RANDOM:
            return grasp
        grasp = _arguments.path(name, grasp)
        try:
            return _text_of(grasp)
        except FileNotFoundError:
            words = f", {' or '.join(map(repr, _RANDOM))}" if random else ""
            raise InputError(f"{name}: file {grasp} not found, expected points, a file{words}") from None
    normals = None
    if isinstance(grasp, tuple) and len(grasp) == 2:
        grasp, normals = grasp
    shape = f"(k, {object.dimension})"
    points = _arguments.numbers(name, grasp, shape, (2,))
    if points.shape[1] != object.dimension:
        raise InputError(f"{name} must have shape {shape}, found {points.shape}")
    contacts = [{"point": point} for point in points.tolist()]
    if normals is not None:
        normals = _arguments.numbers(f"{name}[1]", normals, shape, (2,))
        if normals.shape != points.shape:
            raise InputError(f"{name}[1] must have the shape of the points, {points.shape}, "
                             f"found {normals.shape}")
        for contact, normal in zip(contacts, normals.tolist()):
            contact["normal"] = normal
    return json.dumps({"format": "regrasp-grasp", "version": 1, "contacts": contacts})
