"""Write NPZ files atomically and under exactly the given file name, like the programs."""

from __future__ import annotations

import io

import numpy as np

from . import _regrasp


def write(path: str, **arrays: np.ndarray) -> None:
    """Write arrays by their names."""
    content = io.BytesIO()
    np.savez(content, **arrays)
    _regrasp.write_file(path, content.getvalue())


GRASPS_VERSION = 2
"""Format version of files for `validate --grasps`; version 1 calls the mask `holds` instead of `active`."""


def write_grasps(path: str, **arrays: np.ndarray) -> None:
    """Write the arrays of a file for `validate --grasps`, with its format version."""
    write(path, format_version=np.array(GRASPS_VERSION), **arrays)
