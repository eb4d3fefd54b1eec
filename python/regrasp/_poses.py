"""Batches of positions and quaternions w, x, y, z."""

from __future__ import annotations

import numpy as np

from ._regrasp import InputError


def matrices(quaternions: np.ndarray) -> np.ndarray:
    """Return rotation matrices (…, 3, 3) of quaternions (…, 4)."""
    w, x, y, z = np.moveaxis(quaternions, -1, 0)
    rows = [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]
    return np.moveaxis(np.array(rows), (0, 1), (-2, -1))


def product(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Return the quaternion of the rotation `b` followed by `a`."""
    aw, av, bw, bv = a[..., :1], a[..., 1:], b[..., :1], b[..., 1:]
    return np.concatenate([aw * bw - (av * bv).sum(-1, keepdims=True),
                           aw * bv + bw * av + np.cross(av, bv)], axis=-1)


def inverse(position: np.ndarray, quaternion: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the inverse of a pose as position and quaternion."""
    back = quaternion * [1, -1, -1, -1]
    return -np.einsum("...ij,...j->...i", matrices(back), position), back


def unit(name: str, quaternions) -> np.ndarray:
    """Return normalized quaternions; their norms must already be close to 1."""
    quaternions = np.asarray(quaternions, dtype=float)
    lengths = np.linalg.norm(quaternions, axis=-1, keepdims=True)
    if not (np.abs(lengths - 1) < 1e-2).all():
        raise InputError(f"{name} must be a unit quaternion, found length "
                         f"{lengths.ravel()[np.argmax(np.abs(lengths.ravel() - 1))]:.6g}")
    return quaternions / lengths
