"""Reads the NPY files of dictionaries that numpy.save pickles, and executes nothing in them."""

from __future__ import annotations

import pickle

import numpy as np

from ._regrasp import InputError

# What arrays and numbers of NumPy are made of when they are unpickled; nothing else is looked up.
_ARRAY_PARTS = {
    ("numpy", "ndarray"): np.ndarray,
    ("numpy", "dtype"): np.dtype,
    ("numpy.core.multiarray", "_reconstruct"): np.core.multiarray._reconstruct,
    ("numpy._core.multiarray", "_reconstruct"): np.core.multiarray._reconstruct,
    ("numpy.core.multiarray", "scalar"): np.core.multiarray.scalar,
    ("numpy._core.multiarray", "scalar"): np.core.multiarray.scalar,
}


class _ArraysOnly(pickle.Unpickler):

    def find_class(self, module, name):
        try:
            return _ARRAY_PARTS[module, name]
        except KeyError:
            raise InputError(f"it holds {module}.{name}; only dictionaries, lists, texts, numbers "
                             "and arrays are read") from None

    def persistent_load(self, pid):
        raise InputError("it refers to something outside of it")


def read_dict(path) -> dict:
    """The dictionary of a file that numpy.save wrote of it.

    Raises:
        InputError: it is none, or holds something else than dictionaries, lists, texts, numbers
            and arrays of NumPy.
    """
    try:
        with open(path, "rb") as file:
            version = np.lib.format.read_magic(file)
            header = (np.lib.format.read_array_header_1_0 if version == (1, 0)
                      else np.lib.format.read_array_header_2_0)
            shape, _, dtype = header(file)
            if dtype != np.dtype(object) or shape != ():
                raise InputError(f"a dictionary is needed, found an array of {dtype} {shape}")
            found = _ArraysOnly(file).load()
    except OSError as error:
        raise InputError(f"{path}: {error.strerror}") from None
    except InputError as error:
        raise InputError(f"{path}: {error}") from None
    except Exception as error:  # what a pickle that is cut off or made up brings about
        raise InputError(f"{path}: not a dictionary of NumPy: {error}".replace("\n", " ")) from None
    found = found.item() if isinstance(found, np.ndarray) and found.shape == () else found
    if not isinstance(found, dict):
        raise InputError(f"{path}: a dictionary is needed, found {type(found).__name__}")
    return found
