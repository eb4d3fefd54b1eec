"""Grasps by hands: palm poses and joint angles."""

from __future__ import annotations

import hashlib
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
"""Number of rows in a notebook."""


@dataclass
class WorldPoses:
    """Poses of palms and of the object in the world frame of a file, unchanged."""

    palms: np.ndarray
    """Poses (N, 7) of the palms: positions in metres and quaternions w, x, y, z."""
    objects: np.ndarray
    """Poses (N, 7) of the object, in the same form."""

    def in_object(self) -> tuple[np.ndarray, np.ndarray]:
        """Return positions (N, 3) and quaternions (N, 4) of the palms in the object's frame."""
        position, back = _poses.inverse(self.objects[:, :3], self.objects[:, 3:])
        turned = np.einsum("nij,nj->ni", _poses.matrices(back), self.palms[:, :3])
        return turned + position, _poses.product(back, self.palms[:, 3:])


@dataclass
class HandConfigurations:
    """Palm poses and joint angles of N hands, with the joints of the grasps to which they belong."""

    positions: np.ndarray
    """Positions (N, 3) of the palm frame in the object's frame, m."""
    quaternions: np.ndarray
    """Unit quaternions (N, 4) of the palm frame, w, x, y, z."""
    joints: np.ndarray
    """Joint angles (N, J), radians."""

    def moved(self, palm: np.ndarray, turn: np.ndarray) -> HandConfigurations:
        """Return the configurations with the pose of a frame at `palm` and `turn` in the palm frame."""
        return HandConfigurations(self.positions + _poses.matrices(self.quaternions) @ palm, _poses.product(
            self.quaternions, np.broadcast_to(turn, self.quaternions.shape)), self.joints)


@dataclass
class HandGrasps:
    """N grasps of an object by a hand: palm poses and joint angles."""

    positions: np.ndarray
    """Positions (N, 3) of the palm frame in the object's frame (axes and origin of its file), m."""
    quaternions: np.ndarray
    """Unit quaternions (N, 4) of the palm frame in the object's frame, w, x, y, z."""
    joint_names: list[str]
    """Names of the J joints; empty if the format does not name them."""
    joints: np.ndarray
    """Joint angles (N, J), radians."""
    names: list[str]
    """Names of the N grasps."""
    confidence: np.ndarray
    """Confidences (N,); 1 if the format has none."""
    lost: list[str] = field(default_factory=list)
    """Descriptions of the file's content that is not converted."""
    scales: np.ndarray | None = None
    """Metres per unit of the object's file (N,), if the file of the grasps contains them."""
    world: WorldPoses | None = field(default=None, repr=False, compare=False)
    """Original poses, if the file does not give them in the object's frame."""

    pregrasp: HandConfigurations | None = field(default=None, repr=False, compare=False)
    """Configurations before the hand closes, if the file has them."""
    target: HandConfigurations | None = field(default=None, repr=False, compare=False)
    """Configurations that the actuators are commanded to after the grasp, if the file has them."""
    claimed: np.ndarray | None = None
    """Claimed success (N,), bool, if the file claims it."""
    scored: bool = False
    """Whether the file has the confidences."""
    objects: list[str] | None = None
    """File names of the N objects, if the file names them."""
    set_name: str = ""
    """Name of the format of the data set."""
    closing: dict[str, float] | None = field(default=None, repr=False, compare=False)
    """Closing motion by joint, if the format states it in place of targets: factors of the upper
    limit, and negative ones of the lower limit."""
    directions: np.ndarray | None = field(default=None, repr=False, compare=False)
    """Unit vectors (N, F, 3) in the object's frame along which the F fingertips close, if the file
    has them."""

    def __post_init__(self):
        """Check the arrays.

        Raises:
            InputError: If the shapes of the arrays do not match, or a value is not finite.
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
        """Return the grasps with palm poses, if the file has poses of another link, such as the
        wrist.

        Args:
            palm: Pose of the palm frame in that link's frame. Either shape (7,), position in metres
                and quaternion w, x, y, z, or shape (3,), the position.
        """
        palm = _arguments.numbers("palm", palm, "(3,) or (7,)", (1,))
        if len(palm) not in (3, 7):
            raise InputError(f"palm must have 3 or 7 numbers, found {len(palm)}")
        turn = _poses.unit("palm", palm[3:]) if len(palm) == 7 else np.array([1., 0, 0, 0])
        own = HandConfigurations(self.positions, self.quaternions, self.joints).moved(palm[:3], turn)
        return replace(self, positions=own.positions, quaternions=own.quaternions,
                       pregrasp=self.pregrasp and self.pregrasp.moved(palm[:3], turn),
                       target=self.target and self.target.moved(palm[:3], turn))

    def in_order_of(self, hand: Hand) -> np.ndarray:
        """Return joint angles (N, J) in the order of `hand.joint_names`.

        Args:
            hand: Hand of the grasps.

        Raises:
            InputError: If a joint of the hand is missing, or if the joints have no names and their
                number differs.
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
        """Return the contacts of fingertips: the nearest points of the object's surface.

        Args:
            hand: Hand with F fingers.
            object: Solid that the hand holds. If the grasps have `scales`, these determine its
                size, and its own scale must be the same or 1.
            tolerance: Maximum distance between a fingertip sphere and the surface, and maximum
                depth in the object, of a fingertip in contact, m.

        Returns:
            Points (N, F, 3) in the object's unit, inward unit normals (N, F, 3), and the contact
            mask (N, F).
        """
        tolerance = _arguments.number("tolerance", tolerance, 0)
        points, normals, gaps = self.gaps(hand, object)
        return points, normals, np.abs(gaps) <= tolerance

    def gaps(self, hand: Hand, object: Object) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Measure the distances between the fingertips and the object.

        Args:
            hand: Hand with F fingers.
            object: Solid that the hand holds, as for `touching`.

        Returns:
            Nearest points (N, F, 3) of the surface in the object's unit, inward unit normals (N, F,
            3), and signed distances (N, F) from the surface to the fingertip spheres in metres. A
            distance is negative if a sphere penetrates the object.
        """
        _arguments.of_type("hand", hand, Hand, "; Hand.read reads one")
        if _arguments.of_type("object", object, Object).dimension != 3:
            raise InputError(f"object must be a solid, found the polygon {object.name}")
        return measure_gaps(self, hand, object, self._scales_for(object))

    def _scales_for(self, object: Object) -> np.ndarray:
        """Return metres per unit of the object's file, shape (N,)."""
        if self.scales is None:
            return np.full(len(self), object.scale)
        other = np.flatnonzero(self.scales != object.scale)
        if object.scale != 1 and len(other):
            raise InputError(f"object must have scale 1 or {self.scales[other[0]]:g}, as in grasp {self.names[other[0]]}, "
                             f"found {object.scale:g} for {object.name}")
        return self.scales


def measure_gaps(grasps: HandGrasps, hand: Hand, object: Object,
                 scales: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Measure as `HandGrasps.gaps`, with `scales` (N,): metres per unit of the object's file."""
    tips = hand.tips(grasps.in_order_of(hand))
    turned = np.einsum("nij,nkj->nki", _poses.matrices(grasps.quaternions), tips)
    centres = (turned + grasps.positions[:, None]) / scales[:, None, None]
    points, normals = object.nearest(centres.reshape(-1, 3))
    points, normals = points.reshape(centres.shape), normals.reshape(centres.shape)
    away = centres - points
    side = np.where(np.einsum("nki,nki->nk", away, normals) > 0, -1, 1)  # -1: inside the object
    distances = np.linalg.norm(away, axis=-1) * scales[:, None]
    return points, normals, side * distances - hand.radii


def of_plan(path: str | os.PathLike, hand: Hand) -> HandGrasps:
    """Return the static grasps of a plan for a hand: the initial one, and one after each step.

    The grasps have the name and the scale of the plan's object.

    Args:
        path: Plan file.
        hand: Hand of the plan, which gives the names of its joints.

    Raises:
        InputError: If the plan has no hand, or a different one.
    """
    name, data = hand_plan(path, hand)
    count, entry = 1 + len(data["steps"]), data["object"]
    states, names = [data["hand"]["initial"]], ["000_hold"]
    for i, step in enumerate(data["steps"], 1):
        states.append(next((path[-1] for path in reversed(paths_of(step)) if path), states[-1]))
        names.append(f"{i:03}_{step['kind']}")
    joints = joints_of(states)
    poses = [(np.array(s["pose"]["position"]), _poses.unit(name, s["pose"]["quaternion"]))
             for s in states]
    inverses = [_poses.inverse(*pose) for pose in poses]
    return HandGrasps(np.array([p for p, _ in inverses]), np.array([q for _, q in inverses]),
                      hand.joint_names, joints, names, np.ones(count),
                      ["contacts", "motions between the grasps", "which fingers hold"], np.full(count, entry["scale"]),
                      objects=[os.path.basename(entry["file"])] * count)


def check_object_of_plan(path: str | os.PathLike, hand: Hand) -> None:
    """Check that a file with the name of the plan's object, in the folder of the plan, is this object.

    Args:
        path: Plan file.
        hand: Hand of the plan.

    Raises:
        InputError: If the file has another digest than the object of the plan.
    """
    name, data = hand_plan(path, hand)
    neighbour = os.path.join(os.path.dirname(name), os.path.basename(data["object"]["file"]))
    try:
        with open(neighbour, "rb") as file:
            digest = hashlib.sha256(file.read()).hexdigest()
    except FileNotFoundError:
        return
    if digest != data["object"]["sha256"]:
        raise InputError(f"{name}: {neighbour} is not the object of the plan, expected SHA-256 "
                         f"{data['object']['sha256'][:12]}…, found {digest[:12]}…; help: give the object as --object")
