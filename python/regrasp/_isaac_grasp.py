"""Read and write isaac_grasp 1.0, the YAML format of Isaac Sim's Grasp Editor."""

from __future__ import annotations

import os

import numpy as np

from . import _arguments, _poses, _regrasp
from ._arguments import mapping, member, shown, vector
from ._hand_grasps import HandConfigurations, HandGrasps
from ._regrasp import InputError


def read_isaac_grasp(path: str | os.PathLike) -> HandGrasps:
    """Read a file in the format isaac_grasp 1.0 (YAML; Isaac Sim's Grasp Editor).

    Args:
        path: YAML file.

    Raises:
        InputError: If the file is invalid. The message names the file and the grasp.
    """
    from . import _yaml
    name = path = _arguments.path("path", path)
    data = mapping(name, _yaml.read(path))
    if data.get("format") != "isaac_grasp":
        raise InputError(f"{name}: format must be isaac_grasp, found {shown(data.get('format'))}")
    if data.get("format_version", "1.0") not in ("1.0", "1", 1):
        raise InputError(f"{name}: format_version must be 1.0, found "
                         f"{shown(data['format_version'])}")
    grasps = mapping(f"{name}: grasps", member(name, data, "grasps"))
    positions, quaternions, joints, confidence, lost = [], [], [], [], set()
    joint_names: list | None = None
    for key, grasp in grasps.items():
        where = f"{name}: grasps: {key if str(key).isprintable() else shown(key)}"
        grasp = mapping(where, grasp)
        positions.append(vector(f"{where}: position", member(where, grasp, "position"), 3))
        turn = mapping(f"{where}: orientation", member(where, grasp, "orientation"))
        turn_xyz = member(f"{where}: orientation", turn, "xyz")
        xyz = vector(f"{where}: orientation: xyz", turn_xyz, 3)
        w = vector(f"{where}: orientation: w", [member(f"{where}: orientation", turn, "w")], 1)
        quaternions.append(_poses.unit(f"{where}: orientation", [*w, *xyz]))
        angles = mapping(f"{where}: cspace_position", grasp.get("cspace_position") or {})
        joint_names = list(angles) if joint_names is None else joint_names
        if set(angles) != set(joint_names):
            raise InputError(f"{where}: cspace_position must have the joints of the first grasp")
        joints.append(vector(f"{where}: cspace_position", [angles[j] for j in joint_names],
                              len(joint_names)) if angles else np.zeros(0))
        confidence.append(vector(f"{where}: confidence", [grasp.get("confidence", 1)], 1)[0])
        lost |= set(grasp) - {"position", "orientation", "cspace_position", "confidence"}
    positions, quaternions = np.array(positions).reshape(-1, 3), np.array(quaternions).reshape(-1, 4)
    before = _pregrasp_joints(grasps, joint_names or [])
    return HandGrasps(positions, quaternions, [str(joint) for joint in joint_names or []],
                      np.array(joints).reshape(len(grasps), -1) if grasps else np.zeros((0, 0)),
                      [str(key) for key in grasps], np.array(confidence), sorted(map(str, lost)), scored=True,
                      pregrasp=None if before is None else HandConfigurations(positions, quaternions, before),
                      set_name="isaac_grasp")


def _pregrasp_joints(grasps: dict, names: list) -> np.ndarray | None:
    """Return the joints (N, J) before the grasps; None unless each grasp has all of them."""
    rows = [grasp.get("pregrasp_cspace_position") for grasp in grasps.values()]
    if not rows or not all(isinstance(row, dict) and set(row) == set(names) for row in rows):
        return None
    return _arguments.numbers("pregrasp_cspace_position", [[row[name] for name in names] for row in rows],
                              "(N, J)", (2,))


def write_isaac_grasp(path: str | os.PathLike, grasps: HandGrasps, *, object_frame: str = "object",
                      gripper_frame: str = "palm") -> None:
    """Write a file in the format isaac_grasp 1.0. All numbers are read back with the same bits.

    Args:
        path: YAML file.
        grasps: Grasps to write.
    """
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
    text = yaml.safe_dump({"format": "isaac_grasp", "format_version": "1.0",
                           "object_frame": object_frame, "gripper_frame": gripper_frame,
                           "grasps": entries}, sort_keys=False, default_flow_style=None)
    _regrasp.write_file(path, text.encode())
