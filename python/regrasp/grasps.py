"""Grasps: force closure of contacts with friction, for one grasp or millions."""

from __future__ import annotations

import os
from dataclasses import dataclass, field

import numpy as np

from . import _arguments, _deprecated, _html, _regrasp
from ._regrasp import InputError
from ._types import ArrayLike, Progress
from .objects import Object

# Grasps per part, about a tenth of a second on one processor: half a microsecond, 64 microseconds or up to
# a millisecond each.
_PART, _PART_WITH_ANGLE, _PART_WITH_QUALITY = 200_000, 1500, 300


@dataclass(frozen=True)
class ForceClosure:
    """The result of `force_closure`: scalars for one grasp, arrays (N,) for N grasps."""

    is_force_closure: np.ndarray | bool
    """True if force closure is certified; False for a numerically undecided grasp (`too_close`)."""
    too_close: np.ndarray | bool
    """Whether the grasp is within rounding of the limit (1e-12 of the size of its wrenches)."""
    margin: np.ndarray | float
    """Lower bound on the force-closure margin, dimensionless; positive if and only if `is_force_closure`. It is not
    tight if the verdict is clear early."""
    required_angle_deg: np.ndarray | float | None
    """Smallest friction angle that is proved to be sufficient, degrees. NaN if no angle below 90 degrees
    is; None if not requested."""
    quality: np.ndarray | float | None
    """Lower bound on the grasp quality ε (Ferrari and Canny, 1992, L1 metric): the radius of the largest
    ball of wrenches that normal forces with sum 1 resist, with torques divided by half the object's
    diameter; None if not requested."""
    quality_upper: np.ndarray | float | None = None
    """Upper bound on ε, within 1 % or 1e-6 of `quality`."""
    _asked: tuple | None = field(default=None, repr=False, compare=False)
    """Object, points, normals and friction angle of one grasp, which a notebook draws."""

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
        except InputError:  # a contact is not on the object, which is allowed here
            return ""

    def _table(self) -> str:
        if np.ndim(self.is_force_closure) == 0:
            verdict = ("force closure" if self.is_force_closure else
                       "too close to call" if self.too_close else "no force closure")
            rows = [["verdict", verdict]]
            if 1e-9 < abs(self.margin) < 1e9:  # beyond it, the bound of an early verdict
                rows.append(["margin", f"{self.margin:.4g} or more"])
            if self.required_angle_deg is not None:
                rows.append(["required friction angle", f"{self.required_angle_deg:.2f}°"])
            if self.quality is not None:
                rows.append(["quality", f"{self.quality:.4g} to {self.quality_upper:.4g}"])
            return _html.table(["", "of one grasp"], rows)
        rows = [["force closure", str(int(self.is_force_closure.sum()))],
                ["too close to call", str(int(self.too_close.sum()))]]
        for name, values in (("required friction angle, smallest", self.required_angle_deg),
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
    """Decide whether grasps are force closure under circular friction cones, with certified margins.

    Args:
        points: contact points: array (k, 3) for one grasp of k contacts, (N, k, 3) for N grasps;
            (…, 2) in the plane. In any unit of length, or in that of `object` if it is given.
        normals: unit normals into the object, of the same shape.
        object: object that is held. Only `quality` needs it; points need not be on its surface.
        mu: friction coefficient; give either `mu` or `friction_angle_deg`.
        friction_angle_deg: friction angle, atan(mu), degrees.
        torsion: torsional friction length of soft fingers, in the unit of `points`; 0: hard fingers.
        active: array (k,) or (N, k) of bool, contacts that exist; default: all. Points and normals of
            other contacts are ignored and may be NaN.
        required_angle: whether to compute `ForceClosure.required_angle_deg`, about 0.06 ms per grasp.
        quality: whether to compute `ForceClosure.quality` and its upper bound, which differ by at most
            1 %. It takes about 0.1 ms per grasp of four contacts and up to 2 ms per symmetric grasp.
            The verdict alone takes half a microsecond.
        threads: number of threads; 0: one per processor. Verdicts do not depend on it.
        progress: function that is called with one line of text per part of many grasps. Ctrl-C stops
            the work after the current part.
        touching: deprecated name of `active`.

    Returns:
        Verdicts, margins, and the values that were requested.

    Raises:
        InputError: an argument is invalid; the message names the argument, the grasp and the value.

    Two fingers on opposite faces of a cube can rotate it about the line between them. A third finger,
    or soft fingers, prevent this:

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
    """Return the checked arrays; contacts that do not exist get the point 0 and any unit normal."""
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
    """Return decisions, margins, required friction angles and quality bounds of all grasps.

    Args:
        active: array (N, k) of bool; None: all contacts exist.
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
        if not result:  # a grasp without contacts is not force closure
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
    """Return the results of grasps whose contacts all exist, computed part by part.

    Between two parts the interpreter handles signals.
    """
    results, count = [], len(points)
    for begin in range(0, max(count, 1), part):
        end = min(begin + part, count)
        decisions, lower, _, *measures = judge(points[begin:end], normals[begin:end])
        results.append((decisions, lower, *measures))
        if progress is not None and count > part:
            progress(f"tested {end} of {count} grasps")
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
