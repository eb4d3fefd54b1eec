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


def of_matrices(rotations: np.ndarray) -> np.ndarray:
    """Return unit quaternions (N, 4) of rotation matrices (N, 3, 3).

    Each uses the formula with the largest divisor of four (Shepperd 1978).
    """
    m = rotations
    trace = np.trace(m, axis1=1, axis2=2)
    # Rows k of `columns` are 4 q_k q, for q = w, x, y, z.
    columns = np.stack([
        np.stack([1 + trace, m[:, 2, 1] - m[:, 1, 2], m[:, 0, 2] - m[:, 2, 0], m[:, 1, 0] - m[:, 0, 1]], axis=1),
        np.stack([m[:, 2, 1] - m[:, 1, 2], 1 + 2 * m[:, 0, 0] - trace, m[:, 0, 1] + m[:, 1, 0],
                  m[:, 0, 2] + m[:, 2, 0]], axis=1),
        np.stack([m[:, 0, 2] - m[:, 2, 0], m[:, 0, 1] + m[:, 1, 0], 1 + 2 * m[:, 1, 1] - trace,
                  m[:, 1, 2] + m[:, 2, 1]], axis=1),
        np.stack([m[:, 1, 0] - m[:, 0, 1], m[:, 0, 2] + m[:, 2, 0], m[:, 1, 2] + m[:, 2, 1],
                  1 + 2 * m[:, 2, 2] - trace], axis=1)], axis=1)
    largest = np.argmax(np.einsum("nkk->nk", columns), axis=1)
    chosen = columns[np.arange(len(m)), largest]
    return chosen / np.linalg.norm(chosen, axis=1, keepdims=True)


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
