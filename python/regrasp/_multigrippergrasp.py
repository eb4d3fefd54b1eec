"""Read the JSON files of MultiGripperGrasp, which its simulation in Isaac Sim reads and writes."""

from __future__ import annotations

import json
import os

import numpy as np

from . import _arguments, _poses
from ._arguments import mapping, member, shown
from ._hand_grasps import HandGrasps
from ._regrasp import InputError

_MOST_BYTES = 1 << 30
"""Largest size of a file. The data set has one file per gripper and object."""

JOINT_NAMES = {
    "h5_hand": ["left_link_joint", "right_link_joint", "left_tip_joint", "right_tip_joint"],
    "jaco_robot": ["jaco_finger_joint_0", "jaco_finger_joint_2", "jaco_finger_joint_4"],
    "fetch_gripper": ["l_gripper_finger_joint", "r_gripper_finger_joint"],
    "franka_panda": ["panda_finger_joint1", "panda_finger_joint2"],
    "Allegro": [f"joint_{i}_0" for i in (0, 12, 4, 8, 1, 13, 5, 9, 2, 14, 6, 10, 3, 15, 7, 11)],
    "sawyer": ["finger_joint1", "finger_joint2"],
    "wsg_50": ["base_joint_gripper_left", "base_joint_gripper_right"],
    "Barrett": ["a_palm_link1_joint", "b_palm_link1_joint", "c_palm_link2_joint_0", "a_link1_link2_joint",
                "b_link1_link2_joint", "c_link2_link3_joint", "a_link2_link3_joint", "b_link2_link3_joint"],
    "robotiq_3finger": [
        "RIQ_palm_RIQ_link_0_joint", "RIQ_palm_RIQ_link_0_joint_b", "RIQ_palm_RIQ_link_1_joint_a",
        "RIQ_link_0_RIQ_link_1_joint_c", "RIQ_link_0_RIQ_link_1_joint_b", "RIQ_link_1_RIQ_link_2_joint_a",
        "RIQ_link_1_RIQ_link_2_joint_c", "RIQ_link_1_RIQ_link_2_joint_b", "RIQ_link_2_RIQ_link_3_joint_a",
        "RIQ_link_2_RIQ_link_3_joint_c", "RIQ_link_2_RIQ_link_3_joint_b"],
    "HumanHand": [f"{joint.format(finger)}_joint" for joint in ("palm_{0}1_0", "{0}1_0_{0}1", "{0}1_{0}2", "{0}2_{0}3")
                  for finger in ("index", "mid", "pinky", "ring", "thumb")],
    "shadow_hand": [f"{finger}_joint{i}" for i in range(1, 5) for finger in (
        "index_finger", "little_finger", "middle_finger", "ring_finger", "thumb")] + [
        "little_finger_joint5", "thumb_joint5"],
}
"""Order of the joints by gripper in Isaac Sim, according to the documentation of the data set."""

_CLOSING = {
    "jaco_robot": [1, 1, 1],
    "fetch_gripper": [-1, -1],
    "franka_panda": [-1, -1],
    "Allegro": [0, 0.5, 0, 0, 1, 0, 1, 1, 0, 1, 0, 0, 0, 0, 0, 0],
    "sawyer": [1, 1],
    "wsg_50": [1, -1],
    "Barrett": [0, 0, 1, 1, 1, 0, 0, 0],
    "robotiq_3finger": [0, 0, 1, 1, 1, 1, 1, 1, 0, 0, 0],
    "HumanHand": [0, 0, 0, 0, 0, 1, 1, 1, 1, 0.75, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0],
    "shadow_hand": [0, 1, 0, 0, 1, 1, 0, 1, 1, 0, 1, 1, 1, 1, 0, 0, 1, 0, 0, 1, 0, 0],
}
"""Closing motion of the joints by gripper: `close_dir` of grippers/controller_info.json. The joints
of h5_hand depend on each other, which factors of limits cannot state."""


def read_multigrippergrasp(path: str | os.PathLike) -> HandGrasps:
    """Read a file of MultiGripperGrasp: the grasps of one object by one gripper.

    `pose` has the poses of the gripper's base in the frame of the object, in metres, with
    quaternions w, x, y, z. `dofs` has the joint values in the order of Isaac Sim. For the grippers
    of the data set, the joints have names, and the closing motion is that of its position
    controller. `result` is the claimed success, otherwise a `fall_time`
    of at least the duration of the test.

    Args:
        path: JSON file.

    Raises:
        InputError: If the file is invalid. The message names the file and the member.
    """
    name = path = _arguments.path("path", path)
    data = _read(path)
    gripper = _arguments.text(f"{name}: gripper", member(name, data, "gripper"))
    objects = _arguments.text(f"{name}: object_id", member(name, data, "object_id"))
    poses = _table(f"{name}: pose", member(name, data, "pose"), 7)
    joints = _table(f"{name}: dofs", member(name, data, "dofs"), None)
    if len(joints) != len(poses):
        raise InputError(f"{name}: dofs must have {len(poses)} rows, one per pose, found {len(joints)}")
    names = JOINT_NAMES.get(gripper, [])
    if names and len(poses) and joints.shape[1] != len(names):
        raise InputError(f"{name}: dofs must have {len(names)} joints for {shown(gripper)}, found {joints.shape[1]}")
    stem = os.path.splitext(os.path.basename(name))[0]
    read = {"gripper", "object_id", "pose", "dofs", "result", "fall_time", "test_duration"}
    closing = {joint: factor for joint, factor in zip(names, _CLOSING.get(gripper, [])) if factor != 0}
    return HandGrasps(poses[:, :3], _poses.unit(f"{name}: pose", poses[:, 3:]), names,
                      joints.reshape(len(poses), -1) if len(poses) else np.zeros((0, len(names))),
                      [f"{stem}_{i}" for i in range(len(poses))], np.ones(len(poses)), sorted(map(str, set(data) - read)),
                      claimed=_claims(name, data, len(poses)), objects=[f"{objects}.obj"] * len(poses),
                      set_name="multigrippergrasp", closing=closing or None)


def _read(path: str) -> dict:
    """Return the file's content."""
    if os.path.getsize(path) > _MOST_BYTES:
        raise InputError(f"{path}: file too large, expected at most {_MOST_BYTES} bytes")
    with open(path, "rb") as file:
        try:
            return mapping(path, json.loads(file.read()))
        except (ValueError, RecursionError) as error:
            raise InputError(f"{path}: not a JSON file: {' '.join(str(error).split())}") from None


def _table(where: str, value, columns: int | None) -> np.ndarray:
    """Return numbers (N, columns)."""
    shape = f"(N, {columns or 'J'})"
    if isinstance(value, list) and not value:
        return np.zeros((0, columns or 0))
    table = _arguments.numbers(where, value, shape, (2,))
    if columns is not None and table.shape[1] != columns:
        raise InputError(f"{where} must have shape {shape}, found {table.shape}")
    return table


def _claims(name: str, data: dict, count: int) -> np.ndarray | None:
    """Return the claimed success (N,), or None if the grasps were not tested."""
    key = "result" if "result" in data else "fall_time"
    if key not in data:
        return None
    values = _arguments.numbers(f"{name}: {key}", data[key], f"({count},)", (1,))
    if values.shape != (count,):
        raise InputError(f"{name}: {key} must have {count} numbers, one per pose, found {len(values)}")
    if key == "result":
        return values > 0
    return values >= _arguments.number(f"{name}: test_duration", data.get("test_duration", 3), 0)
