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
                raise InputError(f"{name}: the shape is {text} for {count} names, found {array.shape}")
            setattr(self, name, array)
        self.quaternions = _poses.unit("quaternions", self.quaternions)

    def __len__(self) -> int:
        return len(self.names)

    def _repr_html_(self) -> str:
        rows = [[name, ", ".join(f"{x:.4g}" for x in self.positions[i]),
                 ", ".join(f"{x:.4g}" for x in self.quaternions[i]), f"{self.confidence[i]:.3g}"]
                for i, name in enumerate(self.names[:_ROWS])]
        more = f"{len(self)} grasps" + (f", the first {_ROWS}" if len(self) > _ROWS else "")
        lost = f"; not carried over: {', '.join(self.lost)}" if self.lost else ""
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
            raise InputError(f"palm: 3 numbers are needed, or 7, found {len(palm)}")
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
            raise InputError(f"joints: {hand.name} has {len(hand.joint_names)}, found "
                             f"{self.joints.shape[1]} without names")
        return self.joints

    def touching(self, hand: Hand, object: Object, *,
                 tolerance: float = 0.002) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Where fingertips touch the object: the nearest points of its surface.

        Args:
            hand: the hand, of F fingers.
            object: what it holds, a solid.
            tolerance: a fingertip's ball that is no farther from the surface than this, and no deeper
                in it, touches; metres.

        Returns:
            points (N, F, 3) in the object's unit, unit normals (N, F, 3) into the object, and
            whether the fingertip touches (N, F).
        """
        _arguments.of_type("hand", hand, Hand, "; Hand.read reads one")
        if _arguments.of_type("object", object, Object).dimension != 3:
            raise InputError(f"object: {object.name} is a polygon; hands hold solids")
        tolerance = _arguments.number("tolerance", tolerance, 0)
        tips = hand.tips(self.in_order_of(hand))
        turned = np.einsum("nij,nkj->nki", _poses.matrices(self.quaternions), tips)
        centres = (turned + self.positions[:, None]) / object.scale
        points, normals = object.nearest(centres.reshape(-1, 3))
        points, normals = points.reshape(centres.shape), normals.reshape(centres.shape)
        away = centres - points
        side = np.where(np.einsum("nki,nki->nk", away, normals) > 0, -1, 1)  # -1: in the object
        gaps = side * np.linalg.norm(away, axis=-1) * object.scale - hand.radii
        return points, normals, np.abs(gaps) <= tolerance


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
