"""Write hand grasps as JSON Lines, the format of `evaluate` (docs/format_hand_grasps.md)."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable

import numpy as np

from . import _arguments, _regrasp
from ._hand_grasps import HandConfigurations, HandGrasps
from ._regrasp import InputError

_FORMAT = {"format": "regrasp-hand-grasp", "version": 1}

_WRITTEN = {"pregrasp": ("pregrasp_qpos", "pregrasp_cspace_position"),
            "target": ("squeeze_qpos", "all stages of robot_pose but the second", "grasp_orientations"),
            "objects": ("obj_path",), "claimed": ("succ_flag",), "scales": ("obj_scale", "scale")}
"""Contents that other formats lose, by the attribute of HandGrasps that has them."""


def _configuration(names: list[str], positions, quaternions, joints) -> dict:
    return {"palm": {"position": positions.tolist(), "quaternion": quaternions.tolist()},
            "joints": dict(zip(names, joints.tolist()))}


def _of(configurations: HandConfigurations, names: list[str], i: int) -> dict:
    return _configuration(names, configurations.positions[i], configurations.quaternions[i],
                          configurations.joints[i])


def _object_of(grasps: HandGrasps, i: int, file: str | None) -> str:
    if file is not None:
        return file
    if grasps.objects is None:
        raise InputError(f"grasp {grasps.names[i]} does not name its object; help: regrasp-convert --object names it")
    return grasps.objects[i]


def _line(grasps: HandGrasps, i: int, name: str, file: str | None, scale: float | None) -> dict:
    """Return a grasp as a JSON object."""
    entry = {**_FORMAT, "id": name}
    if grasps.set_name:
        entry["set"] = grasps.set_name
    size = scale if scale is not None else 1.0 if grasps.scales is None else float(grasps.scales[i])
    entry["object"] = {"file": _object_of(grasps, i, file), "scale": size}
    entry |= _configuration(grasps.joint_names, grasps.positions[i], grasps.quaternions[i], grasps.joints[i])
    for key in "pregrasp", "target":
        configurations = getattr(grasps, key)
        if configurations is not None:
            entry[key] = _of(configurations, grasps.joint_names, i)
    if grasps.closing and grasps.target is None:
        entry["closing"] = grasps.closing
    if grasps.claimed is not None:
        entry["claimed"] = bool(grasps.claimed[i])
    if grasps.scored:
        entry["score"] = float(grasps.confidence[i])
    return entry


def not_written(grasps: HandGrasps) -> list[str]:
    """Return descriptions of the file's content that hand grasps do not contain."""
    written = {text for attribute, texts in _WRITTEN.items() if getattr(grasps, attribute) is not None
               for text in texts}
    return [text for text in grasps.lost if text.split(",")[0] not in written and
            not (grasps.scales is not None and text.startswith("scale of scene_cfg"))]


def write_hand_grasps(path: str | os.PathLike, parts: Iterable[tuple[str, HandGrasps]], *,
                      object_file: str | None = None, scale: float | None = None) -> None:
    """Write grasps as JSON Lines for `evaluate`. All numbers are read back with the same bits.

    Args:
        path: Output file.
        parts: Prefix of the names of the grasps, and the grasps, of each input file. The joints
            must have names. Parts may have different hands and objects.
        object_file: Name of the object's file. Default: the name in the file of the grasps.
        scale: Metres per unit of the object's file. Default: that of the grasps, otherwise 1.

    Raises:
        InputError: If joints have no names, a grasp does not name its object, or two grasps have
            the same name.
    """
    path = _arguments.path("path", path)
    lines: list[str] = []
    seen: set[str] = set()
    for prefix, grasps in parts:
        _arguments.of_type("grasps", grasps, HandGrasps)
        if not grasps.joint_names and np.shape(grasps.joints)[1] > 0:
            raise InputError("--hand is required, because the joints have no names")
        for i, own in enumerate(grasps.names):
            name = prefix + own
            if name in seen:
                raise InputError(f"grasp name {_arguments.shown(name)} found twice, expected different names")
            seen.add(name)
            lines.append(json.dumps(_line(grasps, i, name, object_file, scale), allow_nan=False))
    _regrasp.write_file(path, "".join(line + "\n" for line in lines).encode())
