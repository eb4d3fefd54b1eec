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
