"""Hands: fingers with revolute joints and a sphere at each fingertip."""

from __future__ import annotations

import os

import numpy as np

from . import _arguments, _regrasp
from ._regrasp import InputError
from ._types import ArrayLike


class Hand:
    """A hand, as described by its hand file and the model that the file names (docs/format_hand.md).

    A pickle of it has the path of the hand file, and the files are read again.
    """

    def __init__(self, core: _regrasp.Hand):
        if not isinstance(core, _regrasp.Hand):
            raise TypeError("Hand cannot be constructed directly; help: use Hand.read")
        self._core = core
        self._path = ""

    @classmethod
    def read(cls, path: str | os.PathLike) -> Hand:
        """Read a hand file and the MJCF or URDF model that it names.

        Raises:
            InputError: a file is invalid, or the model has features that plans cannot represent.

        >>> Hand.read("models/hands/ring4.json").fingers
        ['finger0', 'finger1', 'finger2', 'finger3']
        """
        path = _arguments.path("path", path)
        hand = cls(_regrasp.read_hand(path))
        hand._path = os.path.abspath(path)
        return hand

    def __reduce__(self):
        return _read_again, (self._path, self._core.sha256)

    @property
    def name(self) -> str:
        """Name of the hand, from its file."""
        return self._core.name

    @property
    def fingers(self) -> list[str]:
        """Names of the F fingers."""
        return self._core.fingers

    @property
    def joint_names(self) -> list[str]:
        """Names of the J joints, finger by finger, from the palm to the fingertip."""
        return [joint for finger in self._core.joint_names for joint in finger]

    @property
    def radii(self) -> np.ndarray:
        """Radii (F,) of the fingertip spheres, metres."""
        return np.array(self._core.radii)

    def tips(self, joints: ArrayLike) -> np.ndarray:
        """Compute the centres of the fingertip spheres in the palm frame, metres.

        Args:
            joints: joint angles (J,) or (N, J), radians, in the order of `joint_names`.

        Returns:
            An array (F, 3) or (N, F, 3).

        >>> Hand.read("models/hands/ring4.json").tips(np.zeros(16)).shape
        (4, 3)
        """
        joints = _arguments.numbers("joints", joints, "(J,) or (N, J)", (1, 2))
        count = len(self.joint_names)
        if joints.shape[-1] != count:
            raise InputError(f"joints must have {count} joints for {self.name}, found shape {joints.shape}")
        tips = self._core.tips(np.atleast_2d(joints))
        return tips[0] if joints.ndim == 1 else tips

    def ordered(self, names: list[str], joints: ArrayLike) -> np.ndarray:
        """Return joint angles in the order of `joint_names`.

        Args:
            names: names of the columns of `joints`; they include all J joints.
            joints: array (N, K) of joint angles for K names.

        Returns:
            An array (N, J).

        Raises:
            InputError: a joint of the hand is missing in `names`.
        """
        names = _arguments.texts("names", names)
        joints = _arguments.numbers("joints", joints, f"(N, {len(names)})", (2,))
        if joints.shape[1] != len(names):
            raise InputError(f"joints must have shape (N, {len(names)}) for {len(names)} names, "
                             f"found {joints.shape}")
        missing = [name for name in self.joint_names if name not in names]
        if missing:
            raise InputError(f"names must contain the joint {missing[0]} of {self.name}, found "
                             f"{_arguments.shown(names)}")
        return joints[:, [names.index(name) for name in self.joint_names]]

    def __repr__(self) -> str:
        return f"<Hand {self.name}: {len(self.fingers)} fingers, {len(self.joint_names)} joints>"


def _read_again(path: str, sha256: str) -> Hand:
    """Read the hand of a pickle."""
    hand = Hand.read(path)
    if hand._core.sha256 != sha256:
        raise InputError(f"{path}: the hand file, its model or a mesh differs from the pickled hand")
    return hand
