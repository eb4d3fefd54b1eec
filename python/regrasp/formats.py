"""Grasps of hands in the formats of other projects (docs/formats.md has the table)."""

from __future__ import annotations

import os
import re
import xml.etree.ElementTree
from dataclasses import dataclass, field, replace

import numpy as np

from . import _arguments, _dict_file, _html, _regrasp
from ._regrasp import InputError
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
        self.names, self.joint_names = _texts("names", self.names), _texts("joint_names",
                                                                            self.joint_names)
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
        self.quaternions = _unit("quaternions", self.quaternions)

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

    def with_palm_at(self, palm) -> HandGrasps:
        """The same grasps, where the poses of a file are not of the palm but of another body of the
        hand, as of its wrist.

        Args:
            palm: the palm's frame in that body's: seven numbers, position in metres and quaternion
                w, x, y, z; or three, the position.
        """
        palm = _arguments.numbers("palm", palm, "(3,) or (7,)", (1,))
        if len(palm) not in (3, 7):
            raise InputError(f"palm: 3 numbers are needed, or 7, found {len(palm)}")
        turn = _unit("palm", palm[3:]) if len(palm) == 7 else np.array([1., 0, 0, 0])
        positions = self.positions + _matrices(self.quaternions) @ palm[:3]
        return replace(self, positions=positions,
                       quaternions=_product(self.quaternions,
                                            np.broadcast_to(turn, self.quaternions.shape)))

    def in_order_of(self, hand: Hand) -> np.ndarray:
        """(N, J) angles in the order of `hand.joint_names`.

        Raises:
            InputError: a joint of the hand is missing, or the number differs where none has a name.
        """
        wanted = _arguments.of_type("hand", hand, Hand, "; Hand.read reads one").joint_names
        if not self.joint_names:
            if self.joints.shape[1] != len(wanted):
                raise InputError(f"joints: {hand.name} has {len(wanted)}, found "
                                 f"{self.joints.shape[1]} without names")
            return self.joints
        missing = [name for name in wanted if name not in self.joint_names]
        if missing:
            raise InputError(f"joints: {hand.name} has {missing[0]}, found "
                             f"{', '.join(self.joint_names)}")
        return self.joints[:, [self.joint_names.index(name) for name in wanted]]

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
        turned = np.einsum("nij,nkj->nki", _matrices(self.quaternions), tips)
        centres = (turned + self.positions[:, None]) / object.scale
        points, normals = _regrasp.nearest(object._core,
                                           np.ascontiguousarray(centres.reshape(-1, 3)))
        points, normals = points.reshape(centres.shape), normals.reshape(centres.shape)
        away = centres - points
        side = np.where(np.einsum("nki,nki->nk", away, normals) > 0, -1, 1)  # -1: in the object
        gaps = side * np.linalg.norm(away, axis=-1) * object.scale - hand.radii
        return points, normals, np.abs(gaps) <= tolerance


def _matrices(quaternions: np.ndarray) -> np.ndarray:
    w, x, y, z = np.moveaxis(quaternions, -1, 0)
    rows = [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]
    return np.moveaxis(np.array(rows), (0, 1), (-2, -1))


def _product(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    aw, av, bw, bv = a[..., :1], a[..., 1:], b[..., :1], b[..., 1:]
    return np.concatenate([aw * bw - (av * bv).sum(-1, keepdims=True),
                           aw * bv + bw * av + np.cross(av, bv)], axis=-1)


def _inverse(position: np.ndarray, quaternion: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    back = quaternion * [1, -1, -1, -1]
    return -np.einsum("...ij,...j->...i", _matrices(back), position), back


def _texts(name: str, values) -> list[str]:
    if not isinstance(values, (list, tuple)) or not all(isinstance(v, str) for v in values):
        raise InputError(f"{name}: a list of texts is needed, found {_arguments.shown(values)}")
    return list(values)


def _unit(name: str, quaternions) -> np.ndarray:
    quaternions = np.asarray(quaternions, dtype=float)
    lengths = np.linalg.norm(quaternions, axis=-1, keepdims=True)
    if not (np.abs(lengths - 1) < 1e-2).all():
        raise InputError(f"{name}: a quaternion of length 1 is needed, found "
                         f"{lengths.ravel()[np.argmax(np.abs(lengths.ravel() - 1))]:.6g}")
    return quaternions / lengths


def _vector(name: str, value, length: int) -> np.ndarray:
    vector = _arguments.numbers(name, value, f"({length},)", (1,))
    if len(vector) != length:
        raise InputError(f"{name}: {length} numbers are needed, found {len(vector)}")
    return vector


def _mapping(name: str, value) -> dict:
    if not isinstance(value, dict):
        raise InputError(f"{name}: a mapping is needed, found {type(value).__name__}")
    return value


def _member(name: str, mapping: dict, key: str):
    if key not in mapping:
        raise InputError(f"{name}: no {key}")
    return mapping[key]


def read_isaac_grasp(path: str | os.PathLike) -> HandGrasps:
    """Reads a file of the format isaac_grasp 1.0 (YAML; Isaac Sim's Grasp Editor).

    Raises:
        InputError: names the file, the grasp and what is wrong.
    """
    import yaml
    name = path = _arguments.path("path", path)
    try:
        with open(path, encoding="utf-8") as file:
            data = _mapping(name, yaml.safe_load(file))
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        raise InputError(f"{name}: no YAML: {error}".replace("\n", " ")) from None
    if data.get("format") != "isaac_grasp":
        raise InputError(f"{name}: format: isaac_grasp is needed, found {data.get('format')!r}")
    if str(data.get("format_version", "1.0")) not in ("1.0", "1"):
        raise InputError(f"{name}: format_version: 1.0 is needed, found {data['format_version']!r}")
    grasps = _mapping(f"{name}: grasps", _member(name, data, "grasps"))
    positions, quaternions, joints, confidence, lost = [], [], [], [], set()
    joint_names: list[str] = []
    for key, grasp in grasps.items():
        where = f"{name}: grasps: {key}"
        grasp = _mapping(where, grasp)
        positions.append(_vector(f"{where}: position", _member(where, grasp, "position"), 3))
        turn = _mapping(f"{where}: orientation", _member(where, grasp, "orientation"))
        turn_xyz = _member(f"{where}: orientation", turn, "xyz")
        xyz = _vector(f"{where}: orientation: xyz", turn_xyz, 3)
        w = _vector(f"{where}: orientation: w", [_member(f"{where}: orientation", turn, "w")], 1)
        quaternions.append(_unit(f"{where}: orientation", [*w, *xyz]))
        angles = _mapping(f"{where}: cspace_position", grasp.get("cspace_position") or {})
        joint_names = joint_names or list(angles)
        if set(angles) != set(joint_names):
            raise InputError(f"{where}: cspace_position: other joints than in the first grasp")
        joints.append(_vector(f"{where}: cspace_position", [angles[j] for j in joint_names],
                              len(joint_names)) if angles else np.zeros(0))
        confidence.append(_vector(f"{where}: confidence", [grasp.get("confidence", 1)], 1)[0])
        lost |= set(grasp) - {"position", "orientation", "cspace_position", "confidence"}
    return HandGrasps(np.array(positions).reshape(-1, 3), np.array(quaternions).reshape(-1, 4),
                      [str(joint) for joint in joint_names],
                      np.array(joints).reshape(len(grasps), -1) if grasps else np.zeros((0, 0)),
                      [str(key) for key in grasps], np.array(confidence), sorted(map(str, lost)))


def write_isaac_grasp(path: str | os.PathLike, grasps: HandGrasps, *, object_frame: str = "object",
                      gripper_frame: str = "palm") -> None:
    """Writes a file of the format isaac_grasp 1.0; all numbers read back as the same bits."""
    import yaml
    path = _arguments.path("path", path)
    _arguments.of_type("grasps", grasps, HandGrasps)
    _arguments.text("object_frame", object_frame)
    _arguments.text("gripper_frame", gripper_frame)
    entries = {}
    for i, name in enumerate(grasps.names):
        angles = dict(zip(grasps.joint_names, grasps.joints[i].tolist()))
        w, *xyz = grasps.quaternions[i].tolist()
        entries[name] = {"confidence": float(grasps.confidence[i]),
                         "position": grasps.positions[i].tolist(),
                         "orientation": {"w": w, "xyz": xyz}, "cspace_position": angles}
    with open(path, "w", encoding="utf-8") as file:
        yaml.safe_dump({"format": "isaac_grasp", "format_version": "1.0",
                        "object_frame": object_frame, "gripper_frame": gripper_frame,
                        "grasps": entries}, file, sort_keys=False, default_flow_style=None)


def read_dexgraspbench(path: str | os.PathLike) -> HandGrasps:
    """Reads an NPY dictionary of DexGraspBench (`grasp_qpos`, `obj_pose`), without executing anything
    in it. Joints that have no names are in the order of the hand's model.

    Raises:
        InputError: names the file, the member and what is wrong.
    """
    name = path = _arguments.path("path", path)
    data = _dict_file.read_dict(path)
    qpos = _arguments.numbers(f"{name}: grasp_qpos", _member(name, data, "grasp_qpos"),
                              "(7 + J,) or (N, 7 + J)", (1, 2))
    qpos = np.atleast_2d(qpos)
    if qpos.shape[1] < 8:
        raise InputError(f"{name}: grasp_qpos: a pose of 7 and joints are needed, found {qpos.shape}")
    joint_names = [str(joint) for joint in data.get("joint_names", [])]
    if joint_names and len(joint_names) != qpos.shape[1] - 7:
        raise InputError(f"{name}: joint_names: {len(joint_names)} for {qpos.shape[1] - 7} joints")
    pose = _vector(f"{name}: obj_pose", _member(name, data, "obj_pose"), 7)
    position, back = _inverse(pose[:3], _unit(f"{name}: obj_pose", pose[3:]))
    palm = _unit(f"{name}: grasp_qpos", qpos[:, 3:7])
    positions = np.einsum("ij,nj->ni", _matrices(back), qpos[:, :3]) + position
    stem = os.path.splitext(os.path.basename(name))[0]
    lost = set(data) - {"grasp_qpos", "obj_pose", "joint_names", "obj_scale"}
    if "obj_scale" in data:
        scale = _arguments.numbers(f"{name}: obj_scale", data["obj_scale"], "() or (1,)", (0, 1))
        lost.add(f"obj_scale, to be given as --scale {scale.ravel()[0]:g}")
    return HandGrasps(positions, _product(np.broadcast_to(back, palm.shape), palm), joint_names,
                      qpos[:, 7:], [f"{stem}_{i}" for i in range(len(qpos))], np.ones(len(qpos)),
                      sorted(map(str, lost)))


_TRANSFORM = re.compile(r"\(\s*(\S+)\s+(\S+)\s+(\S+)\s+(\S+?)\s*\)\s*"
                        r"\[\s*(\S+)\s+(\S+)\s+(\S+?)\s*\]")


def _graspit_pose(name: str, element) -> tuple[np.ndarray, np.ndarray]:
    text = element.findtext("transform/fullTransform", "").strip()
    match = _TRANSFORM.fullmatch(text)
    if not match:
        raise InputError(f"{name}: transform: (w x y z)[x y z] is needed, found {text!r}")
    try:
        values = np.array([float(number) for number in match.groups()])
    except ValueError:
        raise InputError(f"{name}: transform: seven numbers are needed, found {text!r}") from None
    values = _vector(f"{name}: transform", values, 7)
    return values[4:] / 1000, _unit(f"{name}: transform", values[:4])


def read_graspit(path: str | os.PathLike) -> HandGrasps:
    """Reads a world of GraspIt! (XML): the last robot, on the first graspable body. Lengths are
    millimetres. Its degrees of freedom have no names.

    Raises:
        InputError: names the file, the element and what is wrong.
    """
    name = path = _arguments.path("path", path)
    try:
        world = xml.etree.ElementTree.parse(path).getroot()
    except xml.etree.ElementTree.ParseError as error:
        raise InputError(f"{name}: no XML: {error}") from None
    bodies, robots = world.findall("graspableBody"), world.findall("robot")
    if world.tag != "world" or not bodies or not robots:
        raise InputError(f"{name}: a world with a graspableBody and a robot is needed, found "
                         f"{world.tag} with {len(bodies)} and {len(robots)}")
    position, back = _inverse(*_graspit_pose(f"{name}: graspableBody", bodies[0]))
    palm, turn = _graspit_pose(f"{name}: robot", robots[-1])
    text = robots[-1].findtext("dofValues", "").split()
    try:
        joints = np.array([float(number) for number in text])
    except ValueError:
        raise InputError(f"{name}: robot: dofValues: numbers are needed") from None
    _vector(f"{name}: robot: dofValues", joints, len(joints))
    lost = [f"{len(world.findall(tag))} {tag}" for tag in ("obstacle", "connection", "camera")
            if world.findall(tag)]
    lost += [f"{len(items) - 1} other {tag}" for tag, items in
             (("graspableBody", bodies), ("robot", robots)) if len(items) > 1]
    return HandGrasps((_matrices(back) @ palm + position)[None], _product(back, turn)[None], [],
                      joints[None], [os.path.splitext(os.path.basename(name))[0]], np.ones(1), lost)


def of_plan(path: str | os.PathLike, hand: Hand) -> HandGrasps:
    """The grasps at rest of a plan for a hand: the initial one, and one after each step.

    Args:
        path: of the plan file.
        hand: that it is for; names its joints.

    Raises:
        InputError: the plan is for fingers without a hand, or for another one.
    """
    from .plans import Plan
    name = path = _arguments.path("path", path)
    _arguments.of_type("hand", hand, Hand, "; Hand.read reads one")
    data = Plan.read(path).data
    if "hand" not in data:
        raise InputError(f"{name}: a plan for fingers without a hand has no joints")
    if data["hand"]["name"] != hand.name:
        raise InputError(f"{name}: the plan is for {data['hand']['name']}, not {hand.name}")
    states, names = [data["hand"]["initial"]], ["000_hold"]
    for i, step in enumerate(data["steps"], 1):
        motion = step.get("path") if step["kind"] == "move" else step.get("motion", [])
        paths = [motion] if step["kind"] == "move" else (
            [motion["place"], motion["release"]] if isinstance(motion, dict) else motion)
        states.append(next((path[-1] for path in reversed(paths) if path), states[-1]))
        names.append(f"{i:03}_{step['kind']}")
    joints = np.array([[angle for finger in state["joints"] for angle in finger]
                       for state in states])
    if joints.shape[1] != len(hand.joint_names):
        raise InputError(f"{name}: {joints.shape[1]} joints, and {hand.name} has "
                         f"{len(hand.joint_names)}")
    poses = [(np.array(s["pose"]["position"]), _unit(name, s["pose"]["quaternion"]))
             for s in states]
    inverses = [_inverse(*pose) for pose in poses]
    return HandGrasps(np.array([p for p, _ in inverses]), np.array([q for _, q in inverses]),
                      hand.joint_names, joints, names, np.ones(len(states)),
                      ["contacts", "motions between the grasps", "which fingers hold"])
