"""Reports: results of the analytic check and the replay of a plan."""

from __future__ import annotations

import json
import math
import os
from dataclasses import dataclass
from typing import Any

import numpy as np

from . import _arguments, _html, _regrasp
from ._regrasp import InputError
from ._types import Progress
from .hands import Hand
from .objects import Object
from .plans import Plan


@dataclass(frozen=True)
class Trajectory:
    """Motion of the object and the fingers in a replay, without disturbance tests.

    Positions are in metres. Poses are in the palm frame for a replay by a hand, otherwise in the world
    frame, in which the object starts at the pose of its file. N is the number of recorded states.
    """

    time_s: np.ndarray
    """Array (N) of simulated times, seconds."""
    position_m: np.ndarray
    """Array (N, 3) of the positions of the object's origin, metres."""
    quaternion: np.ndarray
    """Array (N, 4) of the orientations of the object, unit quaternions w, x, y, z."""
    step: np.ndarray | None
    """Array (N) of the step of each state, 0 for the initial grasp; None for point fingers."""
    joints: np.ndarray | None
    """Array (N, J) of joint angles of all fingers, radians; None for point fingers."""
    joint_names: list[str] | None
    """Names of the J joints; None for point fingers."""
    fingertips_m: np.ndarray | None
    """Array (N, F, 3) of fingertip positions, metres; None for a hand. The plan does not determine the path of a
    free finger, whose position jumps. A finger that the replay does not have is NaN."""


class Report:
    """The result of `validate`; `data` is report.json as a dict (docs/report.schema.json).

    Reports with the same `text` are equal. A pickle has `text`, `table` and `failure`, the object, the plan and
    the arguments of `validate`. The first use of images, pages or `trajectory` after unpickling validates again.

    A notebook displays the interactive replay, the verdict and a table of the steps with their margins. `text` is
    the content of report.json, `table` a text with one line per step and the verdict. `failure` is one line with
    the failure, its cause and a remedy, or None if the plan passes.
    """

    def __init__(self, core: _regrasp.Report, object: Object, plan: Plan, arguments: dict[str, Any]):
        if not isinstance(core, _regrasp.Report):
            raise TypeError("use regrasp.validate")
        self._made: _regrasp.Report | None = core
        self._object = object
        self._plan = plan
        self._arguments = arguments
        self._drawn: dict[tuple[int, int], tuple] = {}
        self.text: str = core.json
        """Content of report.json."""
        self.data: dict = json.loads(self.text)
        self.table: str = core.table
        """Text with one line per step, the weakest step and the verdict."""
        self.failure: str | None = core.failure
        """Failure, cause and remedy in one line; None if the plan passes."""

    @property
    def _core(self) -> _regrasp.Report:
        """Result of the C++ library. An unpickled report makes it at the first use."""
        if self._made is None:
            again = validate(self._object, self._plan, **self._arguments)
            if again.text != self.text:
                raise InputError(f"{self!r}: differs from the pickled report, which another version of regrasp made")
            self._made = again._made
        return self._made

    def __reduce__(self):
        return _unpickle, (self._object, self._plan, self._arguments, self.text, self.table, self.failure)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Report) and self.text == other.text

    def __hash__(self) -> int:
        return hash(self.text)

    @property
    def passed(self) -> bool:
        """Whether the plan passes."""
        return self.failure is None

    @property
    def steps(self) -> list[dict]:
        """Results of the initial grasp and of each step, as in report.json."""
        return self.data["steps"]

    def frames(self, size: tuple[int, int] = (1280, 960)) -> list[np.ndarray]:
        """Draw the initial grasp and each step, up to the first that fails.

        Args:
            size: width and height, pixels.

        Returns:
            Arrays (height, width, 3) of uint8, RGB, first row at the top.
        """
        return self._draw(size)[0]

    def overview(self, size: tuple[int, int] = (1280, 960)) -> np.ndarray:
        """Draw the overview image: all frames at a small size, with the verdict.

        Args:
            size: width and height of each frame before it is scaled down, pixels.

        Returns:
            An array (height, width, 3) of uint8, RGB, first row at the top.
        """
        return self._draw(size)[1]

    @property
    def trajectory(self) -> Trajectory:
        """Motion of the object and the fingers in the replay, up to the first failure.

        A replay by point fingers has 100 states per second. A replay by a hand has 50, and fewer if it has more
        than 4000 states.

        Raises:
            InputError: nothing was replayed, because the analytic check fails, or a hand was replayed in ODE.
        """
        motion = self._core.motion()
        if motion is None:
            raise InputError(f"{self!r} has no trajectory: no step was replayed in MuJoCo")
        times, poses, *fingers = motion
        pose = {"time_s": times, "position_m": poses[:, :3].copy(), "quaternion": poses[:, 3:].copy()}
        if len(fingers) == 1:
            return Trajectory(**pose, step=None, joints=None, joint_names=None, fingertips_m=fingers[0])
        step, joints, names = fingers
        return Trajectory(**pose, step=step, joints=joints, joint_names=names, fingertips_m=None)

    def video(self, path: str | os.PathLike, size: tuple[int, int] = (1280, 720)) -> None:
        """Write the animation of the replay, as `validate --video FILE` does.

        Args:
            path: file to write. The suffix names the format: .mp4 (H.264), .gif or .webp.
            size: width and height, pixels. An odd width or height of an MP4 is increased by one.

        Raises:
            InputError: the suffix or the size is invalid.
            OSError: the file cannot be written.
        """
        path = _arguments.path("path", path)
        width, height = _size(size)
        _regrasp.write_file(path, self._core.animate(self._object._core, path, width, height))

    def page(self) -> str:
        """Return the HTML report with the interactive 3-D replay and without frames.

        Returns:
            A page that needs no other file and no network, about 1 MB.
        """
        return self._core.format_page(self._object._core, False)

    def write(self, folder: str | os.PathLike, size: tuple[int, int] = (1280, 960)) -> None:
        """Write the report to a folder, which is created if it does not exist.

        Writes report.json, report.html (`page`), overview.png and the frames as 000.png, 001.png, ….

        Args:
            folder: path of the folder; its files of these names are replaced.
            size: width and height of the frames, pixels.

        Raises:
            OSError: a file cannot be written.
        """
        folder = _arguments.path("folder", folder)
        frames, overview = self.frames(size), self.overview(size)
        os.makedirs(folder, exist_ok=True)
        files = {"report.json": self.text.encode(), "report.html": self.page().encode(),
                 "overview.png": _regrasp.encode_png(overview)}
        files.update((f"{i:03}.png", _regrasp.encode_png(frame)) for i, frame in enumerate(frames))
        for name, content in files.items():
            _regrasp.write_file(os.path.join(folder, name), content)

    def _draw(self, size):
        size = _size(size)
        if size not in self._drawn:
            self._drawn[size] = self._core.draw(self._object._core, *size)
        return self._drawn[size]

    def _repr_png_(self) -> bytes:
        return _regrasp.encode_png(self.overview())

    def _repr_html_(self) -> str:
        replay = _html.frame(self._core.format_page(self._object._core, True), repr(self))
        verdict = "pass" if self.passed else f"fail: {self.failure}"
        rows = [_row(step, self._half_angle_deg) for step in self.steps]
        return (replay + _html.text(f"verdict: {verdict}") + _html.table(_COLUMNS, rows)
                + _html.folded("text of validate", self.table))

    @property
    def _half_angle_deg(self) -> float:
        return self.data["settings"]["friction_half_angle_deg"]

    def __str__(self) -> str:
        return self.table

    def __repr__(self) -> str:
        verdict = "pass" if self.passed else self.failure
        return f"<Report of {self.data['plan']['file']}: {verdict}>"


_COLUMNS = ["step", "kind", "required friction angle (°)", "friction margin (°)", "displacement (mm)", "slip (mm)",
            "verdict"]
_NONE = "–"


def _row(step: dict, half_angle_deg: float) -> list[str]:
    """Return the cells of a step in the table of a notebook."""
    closure, simulation = step["force_closure"], step["simulation"]
    required = closure and closure["required_half_angle_deg"]
    # Rounded to the safe side, as in the text of `validate`.
    angles = [_NONE, _NONE] if required is None else [
        f"{math.ceil(100 * required) / 100:.2f}", f"{math.floor(100 * (half_angle_deg - required)) / 100:.2f}"]
    motion = [_NONE, _NONE] if simulation is None else [
        _millimetres(simulation["displacement_m"]), _millimetres(simulation["slip_m"])]
    verdict = step["verdict"] if step["reason"] is None else f"{step['verdict']}: {step['reason']}"
    return [str(step["index"]), step["kind"], *angles, *motion, verdict]


def _millimetres(metres: float | None) -> str:
    """Return a length in millimetres. Motions of less than a micrometre are errors of the simulation."""
    if metres is None:
        return _NONE
    return "<0.001" if metres < 1e-6 else f"{1e3 * metres:.2g}"


def _size(size) -> tuple[int, int]:
    """Check width and height of images."""
    try:
        width, height = size
    except (TypeError, ValueError):
        raise InputError("size must be width and height, found "
                         f"{_arguments.shown(size)}") from None
    limits = _regrasp.least_frame_side, _regrasp.most_frame_side
    return (_arguments.integer("size[0]", width, *limits),
            _arguments.integer("size[1]", height, *limits))


def _unpickle(object: Object, plan: Plan, arguments: dict[str, Any], text: str, table: str,
              failure: str | None) -> Report:
    """Make the report of a pickle, without validating again."""
    report = Report.__new__(Report)
    report._made, report._object, report._plan, report._arguments = None, object, plan, arguments
    report._drawn = {}
    report.text, report.data, report.table, report.failure = text, json.loads(text), table, failure
    return report


def validate(object: Object, plan: Plan, mu: float | None = None, *,
             friction_angle_deg: float | None = None, torsion: float | None = None,
             mass: float | None = None, grasp_force: float | None = None, disturbance: float = 0.01,
             tolerance: float = 0.001, engine: str | None = None, resisted_wrench: bool = False,
             hand: Hand | None = None, replay: str | None = None, tip: str | None = None,
             tolerance_mm: float = 2, tolerance_deg: float = 5, feedback: bool = True,
             progress: Progress = None) -> Report:
    """Check a plan analytically, replay it, and test each static grasp with disturbance wrenches.

    Args:
        object: object that the plan was made for.
        plan: plan from `plan`, `plan_in_hand` or `Plan.read`.
        mu: friction coefficient; default: that of the plan. Give at most one of `mu` and
            `friction_angle_deg`.
        friction_angle_deg: friction angle, degrees.
        torsion: torsional friction length of soft fingers, in the object's unit. 0 means hard fingers;
            the default is that of the plan.
        mass: mass of the object, kg; default: that of the plan, otherwise that of water.
        grasp_force: grasp force (sum of normal forces), N. The default makes the weight a tenth of the
            disturbance force; in a replay by a hand it follows from the torques of the actuators.
        disturbance: disturbance force as a share of the grasp force.
        tolerance: allowed displacement and slip as a share of the object's diameter.
        engine: engine of the replay: "mujoco" (default), "ode", or "both": MuJoCo decides, and steps
            on which the engines differ are listed.
        resisted_wrench: whether to compute the largest disturbance that each grasp resists per direction.
        hand: hand of the plan. Its joints, limits, fingertips and collisions are checked, and images
            show it.
        replay: "points" for ideal point fingers, or "hand" for the hand's model with its actuators;
            default: "hand" if a hand is given.
        tip: shape of fingertips in the replay by a hand. "ball" (default) is the sphere of the hand
            file, for which plans are made; "geometry" is the collision geometry of the model.
        tolerance_mm: allowed distance of the object from its planned position in the replay by a hand.
        tolerance_deg: allowed rotation from its planned orientation in the replay by a hand.
        feedback: whether joint targets follow the measured object pose in the replay by a hand.
        progress: function that is called with one line of text per step.

    Returns:
        The report. A plan that fails is not an exception.

    Raises:
        InputError: the plan is for another object, or an argument is invalid.

    >>> cube = Object.read("models/cube.obj")
    >>> from regrasp import plan
    >>> found = plan(cube, "models/cube.start.json", "models/cube.goal.json", mu=0.4)
    >>> report = validate(cube, found)
    >>> report.passed
    True
    >>> [frame.shape for frame in report.frames((320, 240))]
    [(240, 320, 3), (240, 320, 3), (240, 320, 3)]
    >>> report.page().startswith("<!DOCTYPE html>")
    True
    >>> report.trajectory.position_m.shape == (len(report.trajectory.time_s), 3)
    True
    >>> validate(cube, found, mu=0.05).steps[0]["reason"]
    'not-force-closure'
    >>> both = validate(cube, found, engine="both")
    >>> both.data["settings"]["engine"], both.steps[1]["engines"]["cause"]
    ('both', None)
    """
    _arguments.of_type("object", object, Object)
    _arguments.of_type("plan", plan, Plan, "; Plan.read reads a file")
    arguments = {"mu": mu, "friction_angle_deg": friction_angle_deg, "torsion": torsion, "mass": mass,
                 "grasp_force": grasp_force, "disturbance": disturbance, "tolerance": tolerance, "engine": engine,
                 "resisted_wrench": resisted_wrench, "hand": hand, "replay": replay, "tip": tip,
                 "tolerance_mm": tolerance_mm, "tolerance_deg": tolerance_deg, "feedback": feedback}
    given = _regrasp.ValidationOptions()
    given.half_angle = _arguments.half_angle(mu, friction_angle_deg)
    if torsion is not None:
        given.torsion = _arguments.number("torsion", torsion, 0, zero=True)
    if mass is not None:
        given.mass_kg = _arguments.number("mass", mass, 0)
    if grasp_force is not None:
        given.grasp_force_N = _arguments.number("grasp_force", grasp_force, 0)
    given.disturbance = _arguments.number("disturbance", disturbance, 0, zero=True)
    given.tolerance = _arguments.number("tolerance", tolerance, 0)
    if engine is not None:
        given.set_engine(_arguments.choice("engine", engine, list(_regrasp.engines)))
    given.resisted_wrench = _arguments.flag("resisted_wrench", resisted_wrench)
    if hand is not None:
        _arguments.of_type("hand", hand, Hand, "; Hand.read reads one")
    if hand is not None and "hand" not in plan.data:
        raise InputError(f"hand cannot be used with {plan.name}, which is not a plan for a hand")
    if hand is not None and object.dimension != 3:
        raise InputError(f"with hand, object must be a solid, found the polygon {object.name}")
    if replay is None:
        replay = "points" if hand is None else "hand"
    given.replay_by_hand = _arguments.choice("replay", replay, ["points", "hand"]) == "hand"
    if given.replay_by_hand and hand is None:
        raise InputError('hand is required for replay="hand"')
    if given.replay_by_hand and given.resisted_wrench:
        raise InputError('resisted_wrench requires replay="points"')
    if tip is not None:
        if _arguments.choice("tip", tip, ["ball", "geometry"]) == "geometry":
            given.use_tip_geometry()
        if not given.replay_by_hand:
            raise InputError('tip requires replay="hand"')
    given.set_pose_feedback(_arguments.flag("feedback", feedback))
    given.set_hand_tolerance(_arguments.number("tolerance_mm", tolerance_mm, 0),
                             _arguments.number("tolerance_deg", tolerance_deg, 0))
    return Report(_regrasp.validate_plan(object._core, plan.text, plan.name, given,
                                         hand._core if hand else None,
                                         _arguments.callback("progress", progress)),
                  object, plan, arguments)
