"""Warnings for names that the next version drops."""

from __future__ import annotations

import warnings


def renamed(old: str, new: str) -> None:
    """Warn that a caller of the package uses an old name.

    Args:
        old: name that the caller used, for example "FingerGrasps.holds".
        new: name that replaces it.
    """
    # 3: the caller of the function or property that calls this one.
    warnings.warn(f"{old} is deprecated; use {new}", DeprecationWarning, stacklevel=3)
