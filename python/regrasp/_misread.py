"""Find the likely cause if no fingertip is in contact.

A file of grasps is interpreted differently. The interpretation with fingertips in contact is the
likely cause.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import permutations, product

import numpy as np

from . import _poses
from ._hand_grasps import HandGrasps, WorldPoses, measure_gaps
from .hands import Hand
from .objects import Object

KINDS = "quaternion order, transposed rotations, joints in degrees, lengths in millimetres or palm frame"
"""Tested interpretations."""

_MOST_GRASPS = 24
"""Maximum number of tested grasps."""
_MOST_VISITS = 2e7
"""Budget of visited faces in the search for a palm frame. Each point far from the surface visits
all faces."""
_ROUNDS = 12
_SPARE = 3
"""Number of fingertips required in contact in addition to the three coordinates of a fitted
position."""


@dataclass
class Reading:
    """Grasps in a different interpretation."""

    kind: str
    how: str
    help: str
    grasps: HandGrasps
    units: float = 1
    """Factor of the object's scale."""


@dataclass
class Cause:
    """Interpretation with fingertips in contact."""

    kind: str
    how: str
    help: str
    touching: int
    """Number of fingertips in contact."""
    tips: int
    """Number of tested fingertips."""

    def __str__(self) -> str:
        return (f"{self.kind}: {self.how}, {self.touching} of {self.tips} fingertips touch; "
                f"help: {self.help}")


def likely_cause(grasps: HandGrasps, hand: Hand, object: Object, *, fingers: list[int],
                 tolerance: float, palm: list[float] | None = None,
                 file_scales: np.ndarray | None = None) -> Cause | None:
    """Find the interpretation of a file with the most fingertips in contact.

    Args:
        grasps: Grasps as they were read, without any fingertip in contact.
        hand: Hand of the grasps.
        object: Object that the hand holds. Its scale is used if the grasps have none.
        fingers: Indices of the relevant fingers.
        tolerance: Contact tolerance as for `HandGrasps.touching`, m.
        palm: Pose of the palm frame as for `HandGrasps.with_palm_at`. Default: the poses are those
            of the palm.
        file_scales: Scales (N,) of the file, if different ones were used.

    Returns:
        Likely cause. None if no interpretation has two fingers in contact in half of the grasps, or
        one finger if only one is relevant.
    """
    chosen = np.linspace(0, len(grasps) - 1, min(len(grasps), _MOST_GRASPS)).astype(int)
    tried = _part(grasps, chosen)
    best: Cause | None = None
    for reading in _readings(tried, None if file_scales is None else file_scales[chosen]):
        if palm is not None:
            reading.grasps = reading.grasps.with_palm_at(palm)
        touching = np.abs(_gaps(reading, hand, object)[:, fingers]) <= tolerance
        best = _better(best, reading, touching, tried)
    if best is not None:
        return best
    return _palm_frame(tried, hand, object, fingers, tolerance)


def _part(grasps: HandGrasps, chosen: np.ndarray) -> HandGrasps:
    world = grasps.world
    return replace(
        grasps, positions=grasps.positions[chosen], quaternions=grasps.quaternions[chosen],
        joints=grasps.joints[chosen], names=[grasps.names[i] for i in chosen],
        confidence=grasps.confidence[chosen],
        scales=None if grasps.scales is None else grasps.scales[chosen],
        world=None if world is None else WorldPoses(world.palms[chosen], world.objects[chosen]))


def _better(best: Cause | None, reading: Reading, touching: np.ndarray,
            tried: HandGrasps) -> Cause | None:
    enough = touching.sum(axis=1) >= min(2, touching.shape[1])
    count = int(touching.sum())
    if 2 * int(enough.sum()) < len(tried) or (best is not None and count <= best.touching):
        return best
    return Cause(reading.kind, reading.how, reading.help, count, touching.size)


def _scales(grasps: HandGrasps, object: Object) -> np.ndarray:
    """Return metres per unit of the object's file, shape (N,)."""
    return np.full(len(grasps), object.scale) if grasps.scales is None else grasps.scales


def _gaps(reading: Reading, hand: Hand, object: Object) -> np.ndarray:
    """Return signed distances (N, F), m."""
    scales = _scales(reading.grasps, object) * reading.units
    return measure_gaps(reading.grasps, hand, object, scales)[2]


def _readings(grasps: HandGrasps, file_scales: np.ndarray | None) -> Iterator[Reading]:
    """Yield all interpretations that require no fit."""
    yield from _quaternion_orders(grasps)
    yield Reading("degrees", "with joints in degrees", "give joint angles in radians",
                  replace(grasps, joints=np.radians(grasps.joints)))
    yield from _units(grasps)
    if grasps.scales is not None:
        yield Reading("scale", "without the scale in the file of the grasps", "use --scale 1",
                      replace(grasps, scales=None))
    if file_scales is not None:
        yield Reading("scale", "with the scale in the file of the grasps", "leave --scale out",
                      replace(grasps, scales=file_scales))
    if grasps.world is None:
        yield Reading("rotation", "with transposed rotations of the palm", "give the axes of the palm as columns",
                      replace(grasps, quaternions=grasps.quaternions * [1, -1, -1, -1]))
    back = _poses.inverse(grasps.positions, grasps.quaternions)
    yield Reading("palm frame", "with poses of the object in the palm's frame",
                  "give poses of the palm in the object's frame",
                  replace(grasps, positions=back[0], quaternions=back[1]))


def _moved(grasps: HandGrasps, palms, objects) -> HandGrasps:
    """Return the grasps with both poses of the file changed by functions of (N, 7) arrays."""
    if grasps.world is None:
        changed = palms(np.concatenate([grasps.positions, grasps.quaternions], axis=1))
        return replace(grasps, positions=changed[:, :3], quaternions=changed[:, 3:])
    world = WorldPoses(palms(grasps.world.palms), objects(grasps.world.objects))
    positions, quaternions = world.in_object()
    return replace(grasps, positions=positions, quaternions=quaternions, world=world)


def _same(poses: np.ndarray) -> np.ndarray:
    return poses


def _scaled(poses: np.ndarray, factor: float) -> np.ndarray:
    return np.concatenate([poses[:, :3] * factor, poses[:, 3:]], axis=1)


def _quaternion_orders(grasps: HandGrasps) -> Iterator[Reading]:
    # Either quaternions x, y, z, w were read as w, x, y, z, or w, x, y, z were written as x, y, z,
    # w.
    for by, order in ((1, "x, y, z, w"), (-1, "y, z, w, x")):
        def rolled(poses: np.ndarray, by: int = by) -> np.ndarray:
            return np.concatenate([poses[:, :3], np.roll(poses[:, 3:], by, axis=1)], axis=1)
        whose = [("", rolled, rolled)]
        if grasps.world is not None:
            whose += [(" of the palm", rolled, _same), (" of the object", _same, rolled)]
        for what, palms, objects in whose:
            yield Reading("quaternion order", f"with quaternions{what} read as {order}",
                          "give quaternions as w, x, y, z", _moved(grasps, palms, objects))


def _units(grasps: HandGrasps) -> Iterator[Reading]:
    for factor, unit in ((1e-3, "millimetres"), (1e-2, "centimetres")):
        def smaller(poses: np.ndarray, factor: float = factor) -> np.ndarray:
            return _scaled(poses, factor)
        yield Reading(unit, f"with positions in {unit}", "give positions in metres",
                      _moved(grasps, smaller, smaller))
        if grasps.world is not None:
            yield Reading(unit, f"with positions of the palm in {unit}", "give positions in metres",
                          _moved(grasps, smaller, _same))
        yield Reading(unit, f"with the object's file in {unit}", f"use --scale {factor:g}", grasps,
                      factor)
        yield Reading(unit, f"with positions and the object's file in {unit}",
                      f"use --scale {factor:g}, and give positions in metres",
                      _moved(grasps, smaller, smaller), factor)


def _rotations() -> np.ndarray:
    """Return quaternions (24, 4) of the rotations that permute the axes, the identity first."""
    half = 0.5 ** 0.5
    turns = {tuple(np.round(q, 12)) for signs in product((-1, 1), repeat=4)
             for size in ([1, 0, 0, 0], [half, half, 0, 0], [.5, .5, .5, .5])
             for q in (np.array(order) * signs for order in set(permutations(size)))}
    unique = {q if next(x for x in q if x != 0) > 0 else tuple(-x for x in q) for q in turns}
    return np.array(sorted(unique, key=lambda q: (-q[0], q))) + 0.0


def _palm_frame(grasps: HandGrasps, hand: Hand, object: Object, fingers: list[int],
                tolerance: float) -> Cause | None:
    """Search the pose of the palm frame in the frame of the link whose poses the file may contain.

    It has one of 24 orientations, and a position fitted to the fingertips.
    """
    queries = max(_MOST_VISITS / max(object.face_count, 1), 2000)
    count = max(min(len(grasps), int(queries / 400 / len(hand.fingers))), 1)
    tried = _part(grasps, np.linspace(0, len(grasps) - 1, count).astype(int))
    fit = _PalmFit(tried, hand, object, fingers, tolerance)
    starts = [(fit.cost(turn, shift), i, turn, shift)
              for i, turn in enumerate(_rotations()) for shift in _shifts()]
    best: Cause | None = None
    for _, _, turn, shift in sorted(starts, key=lambda start: start[:2])[:16]:
        shift = fit.refine(turn, shift)
        palm = [*shift, *turn]
        option = ",".join(f"{round(x, 6) + 0.0:g}" for x in (shift if turn[0] == 1 else palm))
        reading = Reading("palm frame", f"with the palm's frame at {option} in the body's whose poses "
                          "the file gives", f"use --palm={option}", grasps.with_palm_at(palm))
        touching = np.abs(_gaps(reading, hand, object)[:, fingers]) <= tolerance
        if int(touching.sum()) >= 3 + _SPARE or (len(grasps) == 1 and touching.all()):
            best = _better(best, reading, touching, grasps)
    return best


def _shifts() -> list[np.ndarray]:
    return [np.zeros(3), *(side * length * axis for axis in np.eye(3) for side in (-1, 1)
                           for length in (0.04, 0.1))]


class _PalmFit:
    """Fit of the position of a palm frame that moves fingertips to the surface."""

    def __init__(self, grasps: HandGrasps, hand: Hand, object: Object, fingers: list[int],
                 tolerance: float):
        self._tips = hand.tips(grasps.in_order_of(hand))[:, fingers]
        self._turns = _poses.matrices(grasps.quaternions)
        self._positions = grasps.positions
        self._radii = hand.radii[fingers]
        self._object = object
        self._scales = _scales(grasps, object)[:, None, None]
        self._least = tolerance / 4

    def _look(self, turn: np.ndarray, shift: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return signed distances (M,) and their gradients (M, 3) in the link's frame."""
        local = self._tips @ _poses.matrices(turn).T + shift
        centres = np.einsum("nij,nkj->nki", self._turns, local) + self._positions[:, None]
        points, inward = self._object.nearest((centres / self._scales).reshape(-1, 3))
        points, inward = points.reshape(centres.shape), inward.reshape(centres.shape)
        away = centres - points * self._scales
        side = np.where(np.einsum("nki,nki->nk", away, inward) > 0, -1, 1)
        distance = np.linalg.norm(away, axis=-1)
        out = np.where(distance[..., None] > 1e-9,
                       side[..., None] * away / np.maximum(distance, 1e-9)[..., None], -inward)
        slopes = np.einsum("nji,nkj->nki", self._turns, out)
        return (side * distance - self._radii).ravel(), slopes.reshape(-1, 3)

    def cost(self, turn: np.ndarray, shift: np.ndarray) -> float:
        """Return the median distance, which is insensitive to fingers without contact in the grasp.
        """
        return float(np.median(np.abs(self._look(turn, shift)[0])))

    def refine(self, turn: np.ndarray, shift: np.ndarray) -> np.ndarray:
        """Return the position after some rounds of least squares, in which far fingertips have a
        small weight."""
        for _ in range(_ROUNDS):
            gaps, slopes = self._look(turn, shift)
            weights = 1 / np.sqrt(np.maximum(np.abs(gaps), self._least))
            step = np.linalg.lstsq(slopes * weights[:, None], -gaps * weights, rcond=1e-3)[0]
            length = np.linalg.norm(step)
            shift = shift + step * min(1, 0.05 / max(length, 1e-12))
            if length < 1e-6:
                break
        return shift
