"""Grasps: contacts with friction, judged by themselves."""

from __future__ import annotations

import os
from dataclasses import dataclass, field

import numpy as np

from . import _arguments, _deprecated, _html, _regrasp
from ._regrasp import InputError
from ._types import ArrayLike, Progress
from .objects import Object

# Grasps that a core judges in about a tenth of a second: half a microsecond, some 64, or up to a
# millisecond each.
_PART, _PART_WITH_ANGLE, _PART_WITH_QUALITY = 200_000, 1500, 300


@dataclass(frozen=True)
class ForceClosure:
    """What `force_closure` says: scalars for one grasp, arrays of shape (N,) for N grasps."""

    is_force_closure: np.ndarray | bool
    """True if force closure is certified; False for a numerically undecided grasp (`too_close`)."""
    too_close: np.ndarray | bool
    """Whether it lies within rounding of the border (1e-12 of the size of its wrenches)."""
    margin: np.ndarray | float
    """A lower bound on the margin, dimensionless; positive iff
    `is_force_closure`. Where the answer is clear
    early it is not tight."""
    required_angle_deg: np.ndarray | float | None
    """The smallest friction half-angle that is proved to be enough; NaN where none is below 90
    degrees; None where it was not asked for."""
    quality: np.ndarray | float | None
    """The largest ball of wrenches that is resisted with normal forces summing to 1, torques over
    half the object's diameter (Ferrari and Canny's L1 metric, its lower bound); None where it was
    not asked for."""
    quality_upper: np.ndarray | float | None = None
    """An upper bound on the same; within 1 % of `quality`, or 1e-6."""
    _asked: tuple | None = field(default=None, repr=False, compare=False)
    """Of one grasp on an object: object, points, normals, half-angle; a notebook draws it."""

    @property
    def holds(self) -> np.ndarray | bool:
        """Deprecated name of `is_force_closure`."""
        _deprecated.renamed("ForceClosure.holds", "is_force_closure")
        return self.is_force_closure

    def _repr_html_(self) -> str:
        return self._table() + self._drawing()

    def _drawing(self) -> str:
        if self._asked is None:
            return ""
        object, points, normals, half_angle = self._asked
        try:
            return _html.drawing(_regrasp.draw_grasp(object._core, points, normals, half_angle, 85),
                                 f"a grasp of {object.name}")
        except InputError:  # a contact is not on the object, which is not asked here
            return ""

    def _table(self) -> str:
        if np.ndim(self.is_force_closure) == 0:
            verdict = ("force closure" if self.is_force_closure else
                       "too close to call" if self.too_close else "no force closure")
            rows = [["verdict", verdict]]
            if 1e-9 < abs(self.margin) < 1e9:  # beyond it is the bound of what was clear early
                rows.append(["margin", f"{self.margin:.4g} or more"])
            if self.required_angle_deg is not None:
                rows.append(["required half-angle", f"{self.required_angle_deg:.2f}°"])
            if self.quality is not None:
                rows.append(["quality", f"{self.quality:.4g} to {self.quality_upper:.4g}"])
            return _html.table(["", "of one grasp"], rows)
        rows = [["force closure", str(int(self.is_force_closure.sum()))],
                ["too close to call", str(int(self.too_close.sum()))]]
        for name, values in (("required half-angle, smallest", self.required_angle_deg),
                             ("quality, largest", self.quality)):
            if values is not None and len(values) and not np.isnan(values).all():
                best = np.nanmin(values) if name.startswith("required") else values.max()
                rows.append([name, f"{best:.4g}" + ("°" if name.startswith("required") else "")])
        return _html.table(["", f"of {len(self.is_force_closure)} grasps"], rows)


def force_closure(points: ArrayLike, normals: ArrayLike, object: Object | None = None,
                  mu: float | None = None, *, friction_angle_deg: float | None = None,
                  torsion: float = 0, active: ArrayLike | None = None,
                  required_angle: bool = False, quality: bool = False, threads: int = 0,
                  progress: Progress = None, touching: ArrayLike | None = None) -> ForceClosure:
    """Decides whether grasps are force closure, with circular friction cones and a certified margin.

    Args:
        points: where the fingers touch, (k, 3) for one grasp of k contacts, (N, k, 3) for N of
            them; (…, 2) in the plane. Any unit of length, `object`'s where that is given.
        normals: of the same shape, unit, into the object.
        object: the object that is held; only `quality` needs it. Whether the points are on its
            surface is not asked.
        mu: friction coefficient, or
        friction_angle_deg: the half-angle of the cones, atan(mu), in degrees.
        torsion: of soft fingers the largest torque about a normal over the largest tangential force,
            in the unit of `points`; 0: hard points, which have no torque.
        active: bool mask of shape (k,) or (N, k) of the contacts that count; None: all. Points and
            normals of the other contacts are ignored and may be NaN.
        required_angle: whether to compute `ForceClosure.required_angle_deg`; some 0.06 ms each.
        quality: whether to compute `ForceClosure.quality` and its upper bound, within 1 % of each
            other and with circular cones. Costs about 0.1 ms for each grasp of four contacts and core, 1 to
            2 ms for symmetric grasps; the verdict alone costs half a microsecond.
        threads: how many work; 0: as many as the machine has cores. Verdicts do not depend on it.
        progress: called with a line of text after each part of many grasps; Ctrl-C ends the work after
            the part that is under way.
        touching: deprecated name of `active`.

    Raises:
        InputError: names the argument, the grasp and the value.

    Two fingers on opposite faces of a cube can turn it about the line between them; a third one
    holds it, and so do soft fingers:

    >>> points = [[0, .5, .5], [1, .3, .5], [1, .7, .5]]
    >>> normals = [[1, 0, 0], [-1, 0, 0], [-1, 0, 0]]
    >>> bool(force_closure(points[:2], normals[:2], mu=0.5).is_force_closure)
    False
    >>> force_closure(points, normals, mu=0.5).is_force_closure
    True
    >>> force_closure(points[:2], normals[:2], mu=0.5, torsion=0.01).is_force_closure
    True
    >>> force_closure(points, normals, mu=0.5, active=[True, True, False]).is_force_closure
    False
    >>> many = force_closure([points] * 1000, [normals] * 1000, mu=0.5, required_angle=True)
    >>> many.is_force_closure.all(), many.required_angle_deg.shape
    (True, (1000,))
    """
    if touching is not None:
        _deprecated.renamed("touching", "active")
        if active is not None:
            raise InputError("active cannot be used with touching, its deprecated name")
        active = touching
    required_angle = _arguments.flag("required_angle", required_angle)
    quality = _arguments.flag("quality", quality)
    points, normals, active = _contacts(points, normals, active)
    dimension = points.shape[-1]
    if object is not None:
        _arguments.of_type("object", object, Object)
        if object.dimension != dimension:
            raise InputError(f"points must have dimension {object.dimension}, as {object.name} has, "
                             f"found shape {points.shape}")
    elif quality:
        raise InputError("object is required for quality, because torques are divided by half its diameter")
    half_angle = _arguments.needed_half_angle(mu, friction_angle_deg)
    torsion = _arguments.number("torsion", torsion, 0, zero=True)
    if torsion > 0 and dimension == 2:
        raise InputError(f"torsion must be 0 in the plane, found {torsion:g}")
    single = points.ndim == 2
    shape = (1 if single else len(points), points.shape[-2], 3)
    points, normals = _in_space(points, shape), _in_space(normals, shape)
    threads = _arguments.integer("threads", threads, 0, 4096)
    # The work for a quality grows steeply with the contacts.
    slow = max(1, int(_PART_WITH_QUALITY * min(1, 4 / shape[1]) ** 3))
    part = (threads or os.cpu_count() or 1) * (
        slow if quality else _PART_WITH_ANGLE if required_angle else _PART)
    decisions, lower, required, worth, most = _judge(
        lambda p, n: _regrasp.judge_grasps(p, n, object._core if object else None, dimension,
                                           half_angle, torsion, required_angle, quality, threads),
        points, normals, None if active is None else active.reshape(shape[:2]), part,
        _arguments.callback("progress", progress))
    is_force_closure = decisions == 2
    too_close = decisions == 1
    angles = np.degrees(required) if required_angle else None
    if not quality:
        worth = most = None
    if not single:
        return ForceClosure(is_force_closure, too_close, lower, angles, worth, most)
    held = slice(None) if active is None else active
    asked = None if object is None else (object, points[0][held], normals[0][held], half_angle)
    return ForceClosure(bool(is_force_closure[0]), bool(too_close[0]), float(lower[0]),
                        None if angles is None else float(angles[0]),
                        None if worth is None else float(worth[0]),
                        None if most is None else float(most[0]), asked)


def _contacts(points, normals, active) -> tuple[np.ndarray, np.ndarray, np.ndarray | None]:
    """The arrays, checked; where no contact is active points are 0 and normals any unit vector."""
    shapes = "(k, 3) or (N, k, 3), in the plane (k, 2) or (N, k, 2)"
    numbers = _arguments.numbers if active is None else _arguments.numbers_or_nan
    points = numbers("points", points, shapes, (2, 3))
    normals = numbers("normals", normals, shapes, (2, 3))
    if points.shape != normals.shape:
        raise InputError(f"normals must have the shape of points, {points.shape}, "
                         f"found {normals.shape}")
    if points.shape[-1] not in (2, 3):
        raise InputError(f"points must have shape {shapes}, found {points.shape}")
    if points.shape[-2] == 0:
        raise InputError(f"points must have at least one contact per grasp, found shape {points.shape}")
    if active is not None:
        active = _arguments.flags("active", active, points.shape[:-1])
        nothing = np.eye(points.shape[-1])[0]
        points = _arguments.finite("points", np.where(active[..., None], points, 0))
        normals = _arguments.finite("normals", np.where(active[..., None], normals, nothing))
    _check_unit(normals)
    return points, normals, active


def _judge(judge, points, normals, active, part: int, progress) -> list[np.ndarray]:
    """Decisions, margins, required half-angles and bounds on the qualities of all grasps.

    Args:
        active: (N, k), or None where all do.
    """
    if active is None or active.all():
        return _in_parts(judge, points, normals, part, progress)
    counts = active.sum(axis=1)
    result: list[np.ndarray] = []
    for count in np.unique(counts[counts > 0]):
        chosen = counts == count
        held = active[chosen]
        found = _in_parts(judge, points[chosen][held].reshape(-1, count, 3),
                          normals[chosen][held].reshape(-1, count, 3), part, progress)
        if not result:  # what nobody holds is not force closure
            result = [np.full(len(counts), fill, column.dtype) if len(column) else column
                      for fill, column in zip((0, np.nan, np.nan, 0, 0), found)]
        for whole, column in zip(result, found):
            if len(column):
                whole[chosen] = column
    if not result:
        result = [np.zeros(len(counts), np.int8), np.full(len(counts), np.nan),
                  np.full(len(counts), np.nan), np.zeros(len(counts)), np.zeros(len(counts))]
    return result


def _in_parts(judge, points, normals, part: int, progress) -> list[np.ndarray]:
    """The same of grasps all of whose contacts are active, part by part: between them the interpreter
    sees to signals."""
    results, count = [], len(points)
    for begin in range(0, max(count, 1), part):
        end = min(begin + part, count)
        decisions, lower, _, *measures = judge(points[begin:end], normals[begin:end])
        results.append((decisions, lower, *measures))
        if progress is not None and count > part:
            progress(f"judged {end} of {count} grasps")
    return [np.concatenate(columns) for columns in zip(*results)]


def _check_unit(normals: np.ndarray) -> None:
    lengths = np.sqrt(np.einsum("...i,...i->...", normals, normals))
    wrong = np.argwhere(np.abs(lengths - 1) > 1e-6)
    if len(wrong):
        place = tuple(int(i) for i in wrong[0])
        raise InputError(f"normals{list(place)} must be a unit vector, "
                         f"found length {lengths[place]:.6g}")


def _in_space(values: np.ndarray, shape: tuple[int, int, int]) -> np.ndarray:
    if values.shape[-1] == 3:
        return values.reshape(shape)
    padded = np.zeros(shape)
    padded[..., :2] = values
    return padded
