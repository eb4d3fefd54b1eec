"""Types of arguments, for type checkers."""

from __future__ import annotations

import os
from typing import Callable, Optional, Sequence, Union

from numpy.typing import ArrayLike

Path = Union[str, bytes, os.PathLike]
Progress = Optional[Callable[[str], object]]
"""A function that is called with one line of text; an exception from it stops the work."""

GivenGrasp = Union[ArrayLike, tuple[ArrayLike, ArrayLike], Path]
"""Points, points and normals, or the path of a grasp file."""

