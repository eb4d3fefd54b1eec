"""Read the HDF5 files of ACRONYM: grasps of one object by a gripper with two fingers."""

from __future__ import annotations

import os

import numpy as np

from . import _arguments, _poses
from ._hand_grasps import HandConfigurations, HandGrasps
from ._regrasp import InputError

_MOST_GRASPS = 1_000_000
"""Largest number of grasps of a file. The data set has 2000 per file."""

_MOST_BYTES = 10_000
"""Largest size of a text."""

_TOLERANCE = 1e-3
"""Largest deviation of a rotation matrix from an orthogonal one."""

_GRASPS, _CLAIM = "grasps/transforms", "grasps/qualities/flex/object_in_gripper"
_FILE, _SCALE = "object/file", "object/scale"
_TYPE, _CONFIGURATION = "gripper/type", "gripper/configuration"

JOINT_NAMES = {"panda": ["panda_finger_joint1", "panda_finger_joint2"]}
"""Joints by gripper. The value in the file is that of each finger."""


def read_acronym(path: str | os.PathLike) -> HandGrasps:
    """Read a file of ACRONYM.

    The poses are those of the gripper in the frame of the object, in metres. The joints have the
    value before the hand closes, because the file has no others, and the target is the closed
    gripper. The claimed success is `object_in_gripper` of the simulation in FleX. Requires h5py.

    Args:
        path: HDF5 file.

    Raises:
        InputError: If h5py is not installed, or the file is invalid. The message names the file and
            the member.
    """
    name = path = _arguments.path("path", path)
    with _open(path) as file:
        poses = _values(name, file, _GRASPS, (None, 4, 4))
        count = len(poses)
        claimed = _values(name, file, _CLAIM, (count,)) > 0 if _has(file, _CLAIM) else None
        scale = _arguments.number(f"{name}: {_SCALE}", float(_values(name, file, _SCALE, ())), 0)
        body = os.path.basename(_text(name, file, _FILE).replace("\\", "/"))
        names, opened = _joints(name, file)
        lost = _others(file)
    if not body:
        raise InputError(f"{name}: {_FILE}: expected the name of a file")
    positions, quaternions = poses[:, :3, 3], _quaternions(f"{name}: {_GRASPS}", poses)
    joints = np.tile(opened, (count, 1))
    stem = os.path.splitext(os.path.basename(name))[0]
    return HandGrasps(positions, quaternions, names, joints, [f"{stem}_{i}" for i in range(count)], np.ones(count),
                      lost, scales=np.full(count, scale), claimed=claimed, objects=[body] * count,
                      target=HandConfigurations(positions, quaternions, np.zeros_like(joints)), set_name="acronym")


def _open(path: str):
    """Open an HDF5 file."""
    try:
        import h5py
    except ImportError:
        raise InputError(f"{path}: cannot be read without the Python module h5py; "
                         "help: install python3-h5py") from None
    with open(path, "rb"):  # a missing file has the usual message
        pass
    try:
        return h5py.File(path, "r")
    except OSError as error:
        raise InputError(f"{path}: not an HDF5 file: {' '.join(str(error).split())}") from None


def _has(file, key: str) -> bool:
    """Return whether a file has a member of its own. Links to other files do not count."""
    import h5py
    parts = key.split("/")
    for i in range(1, len(parts) + 1):
        try:
            if not isinstance(file.get("/".join(parts[:i]), getlink=True), h5py.HardLink):
                return False
        except (KeyError, RuntimeError, ValueError):
            return False
    return True


def _dataset(name: str, file, key: str):
    """Return a dataset whose values are in the file itself."""
    import h5py
    if not _has(file, key):
        raise InputError(f"{name}: {key} not found")
    dataset = file[key]
    if not isinstance(dataset, h5py.Dataset) or dataset.external or dataset.is_virtual:
        raise InputError(f"{name}: {key} must be a dataset with values in this file")
    return dataset


def _read(name: str, dataset, key: str):
    """Return the content of a dataset."""
    try:
        return dataset[()]
    except (OSError, RuntimeError, ValueError, TypeError) as error:
        raise InputError(f"{name}: {key}: {' '.join(str(error).split())}") from None


def _values(name: str, file, key: str, shape: tuple) -> np.ndarray:
    """Return numbers of a shape, in which None is any length."""
    dataset = _dataset(name, file, key)
    found = dataset.shape
    fits = found is not None and len(found) == len(shape) and all(
        want in (None, have) for want, have in zip(shape, found))
    if not fits or dataset.dtype.kind not in "fiub" or any(length > _MOST_GRASPS for length in found):
        wanted = ", ".join("N" if length is None else str(length) for length in shape)
        raise InputError(f"{name}: {key} must be numbers of shape ({wanted}), found {dataset.dtype} of shape {found}")
    return _arguments.finite(f"{name}: {key}", np.asarray(_read(name, dataset, key), dtype=float))


def _text(name: str, file, key: str) -> str:
    """Return a text."""
    dataset = _dataset(name, file, key)
    value = _read(name, dataset, key) if dataset.shape == () and dataset.dtype.itemsize <= _MOST_BYTES else None
    if isinstance(value, bytes):
        value = value.decode("utf-8", errors="replace")
    if not isinstance(value, str) or len(value) > _MOST_BYTES:
        raise InputError(f"{name}: {key} must be a text, found {dataset.dtype} of shape {dataset.shape}")
    return value


def _joints(name: str, file) -> tuple[list[str], np.ndarray]:
    """Return the names of the joints, empty if they are unknown, and their values."""
    gripper = _text(name, file, _TYPE)
    values = _values(name, file, _CONFIGURATION, (None,))
    names = JOINT_NAMES.get(gripper, [])
    if not names:
        return names, values
    if len(values) not in (1, len(names)):
        raise InputError(f"{name}: {_CONFIGURATION} must have 1 or {len(names)} numbers for "
                         f"{_arguments.shown(gripper)}, found {len(values)}")
    return names, np.broadcast_to(values, (len(names),))


def _quaternions(where: str, poses: np.ndarray) -> np.ndarray:
    """Return the quaternions (N, 4) of homogeneous matrices (N, 4, 4)."""
    rotations = poses[:, :3, :3]
    off = np.abs(rotations @ np.swapaxes(rotations, 1, 2) - np.eye(3)).max(axis=(1, 2), initial=0)
    right = np.linalg.det(rotations) > 0
    bad = np.flatnonzero((off > _TOLERANCE) | ~right | (np.abs(poses[:, 3] - [0, 0, 0, 1]) > _TOLERANCE).any(axis=1))
    if len(bad):
        raise InputError(f"{where}[{bad[0]}] must be a homogeneous matrix of a rotation and a translation")
    return _poses.of_matrices(rotations)


def _others(file) -> list[str]:
    """Return the names of all other members of the file."""
    read = {_GRASPS, _CLAIM, _FILE, _SCALE, _TYPE, _CONFIGURATION}
    found: list[str] = []
    file.visit(lambda key: found.append(key) if key not in read and not any(r.startswith(key + "/") for r in read)
               else None)
    return sorted(found)
