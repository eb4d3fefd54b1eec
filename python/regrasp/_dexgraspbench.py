"""Dictionaries of NumPy, as DexGraspBench and BODex keep grasps in them."""

from __future__ import annotations

import os

import numpy as np

from . import _arguments, _dict_file, _poses
from ._arguments import member, vector
from ._hand_grasps import HandGrasps
from ._regrasp import InputError
from ._types import ArrayLike


def read_dexgraspbench(path: str | os.PathLike) -> HandGrasps:
    """Reads a dictionary of DexGraspBench (`grasp_qpos`, `obj_pose`; NPY, or its members as NPZ), without
    executing anything in it. Joints that have no names are in the order of the hand's model.

    Raises:
        InputError: names the file, the member and what is wrong.
    """
    name = path = _arguments.path("path", path)
    data = _dict_file.read_dict(path)
    qpos = _arguments.numbers(f"{name}: grasp_qpos", member(name, data, "grasp_qpos"),
                              "(7 + J,) or (N, 7 + J)", (1, 2))
    pose = vector(f"{name}: obj_pose", member(name, data, "obj_pose"), 7)
    return _grasps(name, data, "grasp_qpos", np.atleast_2d(qpos), pose)


def read_bodex(path: str | os.PathLike, *, object_pose: ArrayLike | None = None) -> HandGrasps:
    """Reads a dictionary as BODex saves it (`robot_pose`, `joint_names`), without executing anything in
    it: of the stages of each grasp the second, in which the fingers touch.

    Args:
        path: of the NPY or NPZ file.
        object_pose: of the object in the file's world, position in metres and quaternion w, x, y, z;
            None: `obj_pose` of the file.

    Raises:
        InputError: names the file, the member and what is wrong.
    """
    name = path = _arguments.path("path", path)
    data = _dict_file.read_dict(path)
    where = f"{name}: robot_pose"
    shape = "(1, N, stages, 7 + J)"
    stages = _arguments.numbers(where, member(name, data, "robot_pose"), shape, (4,))
    if stages.shape[0] != 1 or stages.shape[2] < 2:
        raise InputError(f"{where}: the shape is {shape} with two stages or more, "
                         f"found {stages.shape}")
    if object_pose is not None:
        pose = vector("object_pose", object_pose, 7)
        _poses.unit("object_pose", pose[3:])
    elif "obj_pose" in data:
        pose = _arguments.numbers(f"{name}: obj_pose", data["obj_pose"], "(1, 7)", (1, 2)).ravel()
    else:
        raise InputError(f"object_pose: {name} has no obj_pose, it is to be given")
    grasps = _grasps(name, data, "robot_pose", stages[0, :, 1],
                     vector(f"{name}: obj_pose", pose, 7))
    grasps.lost.append("all stages of robot_pose but the second")
    return grasps


def _grasps(name: str, data: dict, key: str, qpos: np.ndarray, pose: np.ndarray) -> HandGrasps:
    """Of (N, 7 + J) palms and joints in the world, and the object's pose there."""
    if qpos.shape[1] < 8:
        raise InputError(f"{name}: {key}: a pose of 7 and joints are needed, found {qpos.shape}")
    joint_names = data.get("joint_names", [])
    if isinstance(joint_names, np.ndarray):
        joint_names = joint_names.tolist()
    joint_names = _arguments.texts(f"{name}: joint_names", joint_names)
    if joint_names and len(joint_names) != qpos.shape[1] - 7:
        raise InputError(f"{name}: joint_names: {len(joint_names)} for {qpos.shape[1] - 7} joints")
    position, back = _poses.inverse(pose[:3], _poses.unit(f"{name}: obj_pose", pose[3:]))
    palm = _poses.unit(f"{name}: {key}", qpos[:, 3:7])
    positions = np.einsum("ij,nj->ni", _poses.matrices(back), qpos[:, :3]) + position
    stem = os.path.splitext(os.path.basename(name))[0]
    lost = set(data) - {key, "obj_pose", "joint_names", "obj_scale"}
    if "obj_scale" in data:
        scale = _arguments.numbers(f"{name}: obj_scale", data["obj_scale"], "() or (1,)", (0, 1))
        scale = scale.ravel()
        # BODex has it for each axis in some versions.
        if len(scale) == 0 or (scale != scale[0]).any():
            raise InputError(f"{name}: obj_scale: one scale is needed, found "
                             f"{_arguments.shown(scale.tolist())}")
        lost.add(f"obj_scale, to be given as --scale {scale[0]:g}")
    return HandGrasps(positions, _poses.product(np.broadcast_to(back, palm.shape), palm), joint_names,
                      qpos[:, 7:], [f"{stem}_{i}" for i in range(len(qpos))], np.ones(len(qpos)),
                      sorted(lost))
