"""Grasps of hands: where the palm is, and its joints."""

from __future__ import annotations

import os
from dataclasses import dataclass, field, replace

import numpy as np

from . import _arguments, _html, _poses
from ._hand_motion import hand_plan, joints_of, paths_of
from ._regrasp import InputError
from ._types import ArrayLike
from .hands import Hand
from .objects import Object

_ROWS = 10
"""That a notebook shows."""


@dataclass
class WorldPoses:
    """Poses of palms and of the object in the world of a file, as the file has them."""

    palms: np.ndarray
    """(N, 7) positions in metres and quaternions w, x, y, z."""
    objects: np.ndarray
    """(N, 7), likewise."""

    def in_object(self) -> tuple[np.ndarray, np.ndarray]:
        """Positions (N, 3) and quaternions (N, 4) of the palms in the object's frame."""
        position, back = _poses.inverse(self.objects[:, :3], self.objects[:, 3:])
        turned = np.einsum("nij,nj->ni", _poses.matrices(back), self.palms[:, :3])
        return turned + position, _poses.product(back, self.palms[:, 3:])


@dataclass
class HandGrasps:
    """How a hand holds an object, N times: where its palm is, and its joints."""

    positions: np.ndarray
    """(N, 3) of the palm's frame in the object's (its file's axes and origin), metres."""
    quaternions: np.ndarray
    """(N, 4) of the palm's frame in the object's, w, x, y, z, of length 1."""
    joint_names: list[str]
    """Of the J joints; empty where the format does not name them."""
    joints: np.ndarray
    """(N, J) radians."""
    names: list[str]
    """Of the N grasps."""
    confidence: np.ndarray
    """(N,), 1 where the format has none."""
    lost: list[str] = field(default_factory=list)
    """What the file has besides and could not be carried over, in words."""
    scales: np.ndarray | None = None
    """(N,) metres per unit of the object's file, if the file of the grasps has them."""
    world: WorldPoses | None = field(default=None, repr=False, compare=False)
    """The poses as the file has them, if they are not in the object's frame there."""

    def __post_init__(self):
        """
        Raises:
            InputError: the arrays have other shapes than each other, or values that are not finite.
        """
        self.names = _arguments.texts("names", self.names)
        self.joint_names = _arguments.texts("joint_names", self.joint_names)
        count, joints = len(self.names), len(self.joint_names)
        for name, shape in [("positions", (count, 3)), ("quaternions", (count, 4)),
                            ("joints", (count, joints)), ("confidence", (count,))]:
            text = "(" + ", ".join(map(str, shape)) + ("," if len(shape) == 1 else "") + ")"
            text = text if name != "joints" or joints else f"({count}, J)"
            array = _arguments.numbers(name, getattr(self, name), text, (len(shape),))
            unnamed = name == "joints" and not joints and len(array) == count
            if array.shape != shape and not unnamed:
                raise InputError(f"{name} must have shape {text} for {count} names, found {array.shape}")
            setattr(self, name, array)
        self.quaternions = _poses.unit("quaternions", self.quaternions)
        if self.scales is not None:
            self.scales = _arguments.numbers("scales", self.scales, f"({count},)", (1,))
            if self.scales.shape != (count,) or not (self.scales > 0).all():
                raise InputError(f"scales must be {count} numbers above 0, found "
                                 f"{_arguments.shown(self.scales.tolist())}")

    def __len__(self) -> int:
        return len(self.names)

    def _repr_html_(self) -> str:
        rows = [[name, ", ".join(f"{x:.4g}" for x in self.positions[i]),
                 ", ".join(f"{x:.4g}" for x in self.quaternions[i]), f"{self.confidence[i]:.3g}"]
                for i, name in enumerate(self.names[:_ROWS])]
        more = f"{len(self)} grasps" + (f", the first {_ROWS}" if len(self) > _ROWS else "")
        lost = f"; not converted: {', '.join(self.lost)}" if self.lost else ""
        return _html.text(f"{more}, {self.joints.shape[1]} joints{lost}") + _html.table(
            ["grasp", "palm (m)", "quaternion w, x, y, z", "confidence"], rows)

    def with_palm_at(self, palm: ArrayLike) -> HandGrasps:
        """The same grasps, where the poses of a file are not of the palm but of another body of the
        hand, as of its wrist.

        Args:
            palm: the palm's frame in that body's: seven numbers, position in metres and quaternion
                w, x, y, z; or three, the position.
        """
        palm = _arguments.numbers("palm", palm, "(3,) or (7,)", (1,))
        if len(palm) not in (3, 7):
            raise InputError(f"palm must have 3 or 7 numbers, found {len(palm)}")
        turn = _poses.unit("palm", palm[3:]) if len(palm) == 7 else np.array([1., 0, 0, 0])
        positions = self.positions + _poses.matrices(self.quaternions) @ palm[:3]
        return replace(self, positions=positions,
                       quaternions=_poses.product(self.quaternions,
                                            np.broadcast_to(turn, self.quaternions.shape)))

    def in_order_of(self, hand: Hand) -> np.ndarray:
        """(N, J) angles in the order of `hand.joint_names`.

        Raises:
            InputError: a joint of the hand is missing, or the number differs where none has a name.
        """
        _arguments.of_type("hand", hand, Hand, "; Hand.read reads one")
        if self.joint_names:
            return hand.ordered(self.joint_names, self.joints)
        if self.joints.shape[1] != len(hand.joint_names):
            raise InputError(f"joints must have {len(hand.joint_names)} columns for {hand.name}, found "
                             f"{self.joints.shape[1]} without names")
        return self.joints

    def touching(self, hand: Hand, object: Object, *,
                 tolerance: float = 0.002) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Where fingertips touch the object: the nearest points of its surface.

        Args:
            hand: the hand, of F fingers.
            object: what it holds, a solid. Its size is that of `scales`, if the grasps have them;
                its own scale must then be the same, or 1.
            tolerance: a fingertip's ball that is no farther from the surface than this, and no deeper
                in it, touches; metres.

        Returns:
            points (N, F, 3) in the object's unit, unit normals (N, F, 3) into the object, and
            whether the fingertip touches (N, F).
        """
        tolerance = _arguments.number("tolerance", tolerance, 0)
        points, normals, gaps = self.gaps(hand, object)
        return points, normals, np.abs(gaps) <= tolerance

    def gaps(self, hand: Hand, object: Object) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Measure how far the fingertips are from the object.

        Args:
            hand: the hand, of F fingers.
            object: what it holds, as for `touching`.

        Returns:
            The nearest points (N, F, 3) of the surface in the object's unit, unit normals (N, F, 3)
            into the object, and signed distances (N, F) from the surface to the fingertips' balls in
            metres, negative if a ball reaches into the object.
        """
        _arguments.of_type("hand", hand, Hand, "; Hand.read reads one")
        if _arguments.of_type("object", object, Object).dimension != 3:
            raise InputError(f"object must be a solid, found the polygon {object.name}")
        return measure_gaps(self, hand, object, self._scales_for(object))

    def _scales_for(self, object: Object) -> np.ndarray:
        """(N,) metres per unit of the object."""
        if self.scales is None:
            return np.full(len(self), object.scale)
        other = np.flatnonzero(self.scales != object.scale)
        if object.scale != 1 and len(other):
            raise InputError(f"object must have scale 1 or {self.scales[other[0]]:g}, as in grasp {self.names[other[0]]}, "
                             f"found {object.scale:g} for {object.name}")
        return self.scales


def measure_gaps(grasps: HandGrasps, hand: Hand, object: Object,
                 scales: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Measure as `HandGrasps.gaps`, with an object of (N,) metres per unit of its file."""
    tips = hand.tips(grasps.in_order_of(hand))
    turned = np.einsum("nij,nkj->nki", _poses.matrices(grasps.quaternions), tips)
    centres = (turned + grasps.positions[:, None]) / scales[:, None, None]
    points, normals = object.nearest(centres.reshape(-1, 3))
    points, normals = points.reshape(centres.shape), normals.reshape(centres.shape)
    away = centres - points
    side = np.where(np.einsum("nki,nki->nk", away, normals) > 0, -1, 1)  # -1: in the object
    distances = np.linalg.norm(away, axis=-1) * scales[:, None]
    return points, normals, side * distances - hand.radii


def of_plan(path: str | os.PathLike, hand: Hand) -> HandGrasps:
    """The grasps at rest of a plan for a hand: the initial one, and one after each step.

    Args:
        path: of the plan file.
        hand: that it is for; names its joints.

    Raises:
        InputError: the plan is for fingers without a hand, or for another one.
    """
    name, data = hand_plan(path, hand)
    states, names = [data["hand"]["initial"]], ["000_hold"]
    for i, step in enumerate(data["steps"], 1):
        states.append(next((path[-1] for path in reversed(paths_of(step)) if path), states[-1]))
        names.append(f"{i:03}_{step['kind']}")
    joints = joints_of(states)
    poses = [(np.array(s["pose"]["position"]), _poses.unit(name, s["pose"]["quaternion"]))
             for s in states]
    inverses = [_poses.inverse(*pose) for pose in poses]
    return HandGrasps(np.array([p for p, _ in inverses]), np.array([q for _, q in inverses]),
                      hand.joint_names, joints, names, np.ones(len(states)),
                      ["contacts", "motions between the grasps", "which fingers hold"])
