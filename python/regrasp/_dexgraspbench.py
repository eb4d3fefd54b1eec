"""Read the NumPy dictionaries in which DexGraspBench, Dexonomy and BODex store grasps."""

from __future__ import annotations

import os

import numpy as np

from . import _arguments, _dict_file, _poses
from ._arguments import member, vector
from ._hand_grasps import HandConfigurations, HandGrasps, WorldPoses
from ._regrasp import InputError
from ._types import ArrayLike

_NO_POSE = ("no obj_pose, expected obj_pose or a scene_cfg with the object's pose; help: give the pose "
            "as object_pose (regrasp-convert --object-pose)")


def read_dexgraspbench(path: str | os.PathLike, *,
                       object_pose: ArrayLike | None = None) -> HandGrasps:
    """Read a dictionary of DexGraspBench or Dexonomy.

    The file has `grasp_qpos`, and `obj_pose` or `scene_cfg`. It is an NPY file, or an NPZ file of
    the members. No code in it is executed. Joints without names are in the order of the hand's
    model.

    Args:
        path: NPY or NPZ file.
        object_pose: Pose of the object in the file's world frame, shape (7,): position in metres
            and quaternion w, x, y, z. Default: the pose in the file.

    Raises:
        InputError: If the file is invalid. The message names the file and the member.
    """
    name = path = _arguments.path("path", path)
    data = _dict_file.read_dict(path)
    qpos = _arguments.numbers(f"{name}: grasp_qpos", member(name, data, "grasp_qpos"),
                              "(7 + J,) or (N, 7 + J)", (1, 2))
    return _grasps(name, data, "grasp_qpos", np.atleast_2d(qpos), object_pose)


def read_bodex(path: str | os.PathLike, *, object_pose: ArrayLike | None = None) -> HandGrasps:
    """Read a dictionary of BODex (`robot_pose`, `joint_names`).

    The second stage of each grasp is read, in which the fingers are in contact. No code in the file
    is executed.

    Args:
        path: NPY or NPZ file.
        object_pose: Pose of the object in the file's world frame, shape (7,): position in metres
            and quaternion w, x, y, z. Default: `obj_pose` of the file.

    Raises:
        InputError: If the file is invalid. The message names the file and the member.
    """
    name = path = _arguments.path("path", path)
    data = _dict_file.read_dict(path)
    where = f"{name}: robot_pose"
    shape = "(1, N, stages, 7 + J)"
    stages = _arguments.numbers(where, member(name, data, "robot_pose"), shape, (4,))
    if stages.shape[0] != 1 or stages.shape[2] < 2:
        raise InputError(f"{where} must have shape {shape} with at least two stages, "
                         f"found {stages.shape}")
    sequence = {"pregrasp_qpos": stages[0, :, 0], "squeeze_qpos": stages[0, :, 2]} if stages.shape[2] > 2 else {}
    grasps = _grasps(name, data, "robot_pose", stages[0, :, 1], object_pose, sequence, "bodex")
    grasps.lost.append("all stages of robot_pose but the second")
    return grasps


def _scene_object(name: str, data: dict) -> dict | None:
    """Return the grasped object of Dexonomy's `scene_cfg`; None if there is no `scene_cfg`."""
    if "scene_cfg" not in data:
        return None
    where = f"{name}: scene_cfg"
    config = _arguments.mapping(where, data["scene_cfg"])
    scene = _arguments.mapping(f"{where}: scene", member(where, config, "scene"))
    if "interest_obj_name" in config:
        key = _arguments.text(f"{where}: interest_obj_name", config["interest_obj_name"])
    elif len(scene) == 1:
        key = next(iter(scene))
    else:
        raise InputError(f"{where}: interest_obj_name not found, required for {len(scene)} objects")
    return _arguments.mapping(f"{where}: scene: {key}", member(f"{where}: scene", scene, key))


def _object_pose(name: str, data: dict, scene: dict | None, given: ArrayLike | None) -> np.ndarray:
    """Return the pose of the object in the file's world frame, shape (7,)."""
    if given is not None:
        where, pose = "object_pose", vector("object_pose", given, 7)
    elif "obj_pose" in data or (scene is not None and "pose" in scene):
        where, pose = ((f"{name}: obj_pose", data["obj_pose"]) if "obj_pose" in data else
                       (f"{name}: scene_cfg: pose", scene["pose"]))
        pose = vector(where, _arguments.numbers(where, pose, "(7,) or (1, 7)", (1, 2)).ravel(), 7)
    else:
        raise InputError(f"{name}: {_NO_POSE}")
    return np.concatenate([pose[:3], _poses.unit(where, pose[3:])])


def _scale(where: str, value) -> float:
    """Return the uniform scale. Some versions of BODex and Dexonomy store it per axis."""
    scale = _arguments.numbers(where, value, "(), (1,) or (3,)", (0, 1)).ravel()
    if len(scale) == 0 or (scale != scale[0]).any():
        raise InputError(f"{where} must be one scale, found {_arguments.shown(scale.tolist())}")
    return _arguments.number(where, scale[0], 0)


def _joint_names(name: str, data: dict, count: int) -> list[str]:
    names = data.get("joint_names", [])
    if isinstance(names, np.ndarray):
        names = names.tolist()
    names = _arguments.texts(f"{name}: joint_names", names)
    if names and len(names) != count:
        raise InputError(f"{name}: joint_names must have {count} names, one per joint, found {len(names)}")
    return names


def _configurations(qpos, count: int, columns: int, pose: np.ndarray) -> HandConfigurations | None:
    """Return configurations of palms and joints (N, 7 + J) in the world frame; None if they are not such."""
    try:
        qpos = np.atleast_2d(np.asarray(qpos, dtype=float))
        if qpos.shape != (count, columns) or not np.isfinite(qpos).all():
            return None
        palms = np.concatenate([qpos[:, :3], _poses.unit("", qpos[:, 3:7])], axis=1)
    except (InputError, TypeError, ValueError):
        return None
    world = WorldPoses(palms, np.broadcast_to(pose, palms.shape).copy())
    return HandConfigurations(*world.in_object(), qpos[:, 7:])


def _object_names(data: dict, count: int) -> list[str] | None:
    """Return the file names of the objects: the last component of `obj_path`."""
    path = data.get("obj_path", data.get("interest_obj_name"))
    stem = os.path.basename(path.rstrip("/")) if isinstance(path, str) else ""
    return [f"{stem}.obj"] * count if stem else None


def _claims(data: dict, count: int) -> np.ndarray | None:
    """Return `succ_flag` as booleans (N,); None if there is none."""
    flags = np.asarray(data.get("succ_flag"))
    if flags.dtype.kind not in "bi" or flags.size not in (1, count):
        return None
    return np.broadcast_to(flags.ravel().astype(bool), (count,)).copy()


def _grasps(name: str, data: dict, key: str, qpos: np.ndarray, object_pose: ArrayLike | None,
            sequence: dict | None = None, set_name: str = "dexgraspbench") -> HandGrasps:
    """Return grasps from palms and joints (N, 7 + J) and the object's pose in the world frame."""
    if qpos.shape[1] < 8:
        raise InputError(f"{name}: {key} must have 7 numbers for the pose and one per joint, found shape {qpos.shape}")
    scene = _scene_object(name, data)
    pose = _object_pose(name, data, scene, object_pose)
    joint_names = _joint_names(name, data, qpos.shape[1] - 7)
    lost = set(data) - {key, "obj_pose", "joint_names", "obj_scale"}
    if object_pose is not None and (lost & {"scene_cfg"} or "obj_pose" in data):
        lost.add("the object's pose, replaced by the one that is given")
    scale = None
    if "obj_scale" in data:
        scale = _scale(f"{name}: obj_scale", data["obj_scale"])
        lost.add(f"obj_scale, to be given as --scale {scale:g}")
    elif scene is not None and "scale" in scene:
        scale = _scale(f"{name}: scene_cfg: scale", scene["scale"])
        lost.add(f"scale of scene_cfg, to be given as --scale {scale:g}")
    if "scene_cfg" in lost:
        lost.remove("scene_cfg")
        lost.add("scene_cfg but the object's pose and scale")
    palms = np.concatenate([qpos[:, :3], _poses.unit(f"{name}: {key}", qpos[:, 3:7])], axis=1)
    world = WorldPoses(palms, np.broadcast_to(pose, palms.shape).copy())
    stem = os.path.splitext(os.path.basename(name))[0]
    return HandGrasps(*world.in_object(), joint_names, qpos[:, 7:],
                      [f"{stem}_{i}" for i in range(len(qpos))], np.ones(len(qpos)), sorted(lost),
                      None if scale is None else np.full(len(qpos), scale), world,
                      *(_configurations((data if sequence is None else sequence).get(stage), *qpos.shape, pose)
                        for stage in ("pregrasp_qpos", "squeeze_qpos")),
                      claimed=_claims(data, len(qpos)), objects=_object_names(data, len(qpos)), set_name=set_name)
