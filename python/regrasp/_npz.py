"""NPZ files, written as the programs write files: as a whole, under the very name that is given."""

from __future__ import annotations

import io

import numpy as np

from . import _regrasp


def write(path: str, **arrays: np.ndarray) -> None:
    """Writes arrays by their names."""
    content = io.BytesIO()
    np.savez(content, **arrays)
    _regrasp.write_file(path, content.getvalue())
