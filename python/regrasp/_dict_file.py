"""Read dictionaries pickled by numpy.save, and NPZ files, without executing code in them."""

from __future__ import annotations

import pickle
import pickletools
import zipfile

import numpy as np

from . import _arguments
from ._regrasp import InputError


class _Array:
    """Placeholder of numpy.ndarray, whose constructor would allocate memory of any size."""


def _reconstruct(kind, shape, dtype):
    """Return an array without content, as NumPy pickles it."""
    if kind is not _Array or shape != (0,):
        raise InputError("contains an array that NumPy did not write")
    return np.core.multiarray._reconstruct(np.ndarray, shape, dtype)


# The only functions and classes that unpickling may use: the parts of NumPy arrays and numbers.
_ARRAY_PARTS = {
    ("numpy", "ndarray"): _Array,
    ("numpy", "dtype"): np.dtype,
    ("numpy.core.multiarray", "_reconstruct"): _reconstruct,
    ("numpy._core.multiarray", "_reconstruct"): _reconstruct,
    ("numpy.core.multiarray", "scalar"): np.core.multiarray.scalar,
    ("numpy._core.multiarray", "scalar"): np.core.multiarray.scalar,
}


# Forbidden pickle operations: creation of class instances, external references, shared memory.
_NOT_DATA = {"PERSID", "BINPERSID", "INST", "OBJ", "NEWOBJ", "NEWOBJ_EX", "EXT1", "EXT2", "EXT4",
             "BYTEARRAY8", "NEXT_BUFFER", "READONLY_BUFFER"}


class _ArraysOnly(pickle.Unpickler):

    def find_class(self, module, name):
        try:
            return _ARRAY_PARTS[module, name]
        except KeyError:
            raise InputError(f"contains {module}.{name}, expected only dict, list, str, numbers "
                             "and arrays") from None


def _unpickle(file):
    begin = file.tell()
    for operation, _, _ in pickletools.genops(file):
        if operation.name in _NOT_DATA:
            raise InputError(f"contains {operation.name}, expected only dict, list, str, numbers "
                             "and arrays")
    file.seek(begin)
    return _ArraysOnly(file).load()


def _read_array(file):
    """Return the content of an NPY file; for objects, the unpickled content."""
    version = np.lib.format.read_magic(file)
    begin = file.tell()
    header = (np.lib.format.read_array_header_1_0 if version == (1, 0)
              else np.lib.format.read_array_header_2_0)
    _, _, dtype = header(file)
    if dtype.hasobject:
        return _unpickle(file)
    file.seek(begin - np.lib.format.MAGIC_LEN)
    return np.lib.format.read_array(file, allow_pickle=False)


def _content(path):
    """Return the content of an NPY file, or the members of an NPZ file as a dictionary."""
    with open(path, "rb") as file:
        if not zipfile.is_zipfile(file):
            file.seek(0)
            return _read_array(file)
        with zipfile.ZipFile(file) as archive:
            members = {}
            for name in archive.namelist():
                with archive.open(name) as member:
                    members[name.removesuffix(".npy")] = _plain(_read_array(member))
            return members


def _plain(value):
    """Return the element of a zero-dimensional array, or any other value unchanged."""
    return value.item() if isinstance(value, np.ndarray) and value.shape == () else value


def read_content(path) -> dict | list[dict]:
    """Return the dictionary or dictionaries of an NPY or NPZ file.

    The file is an NPY file of a dictionary written by numpy.save, an NPZ file, or an NPY file of an
    array or a list of dictionaries.

    Args:
        path: NPY or NPZ file.

    Raises:
        InputError: If the file is not such a file, or contains anything except dictionaries, lists,
            texts, numbers and arrays of NumPy.
    """
    try:
        found = _plain(_content(path))
    except OSError as error:
        raise InputError(f"{path}: {error.strerror or error}") from None
    except InputError as error:
        raise InputError(f"{path}: {error}") from None
    except Exception as error:  # caused by truncated or forged pickles
        reason = str(error).replace("\n", " ")
        raise InputError(f"{path}: expected an NPY or NPZ file of dictionaries, found a file that "
                         f"cannot be read: {reason}") from None
    several = isinstance(found, list) or (
        isinstance(found, np.ndarray) and found.dtype == object and found.ndim == 1)
    entries = list(found) if several else [found]
    for i, entry in enumerate(entries):
        at = f"{path}[{i}]" if several else path
        if not isinstance(entry, dict):
            what = (f"an array of {entry.dtype}" if isinstance(entry, np.ndarray)
                    else type(entry).__name__)
            raise InputError(f"{at} must be a dictionary, found {what}")
        if not all(isinstance(key, str) for key in entry):
            raise InputError(f"{at}: keys of the dictionary must be str")
    _arguments.bounded(path, entries)
    return entries if several else found


def read_dict(path) -> dict:
    """Return the dictionary of a file as `read_content` does; a list is an error.

    Raises:
        InputError: If the content is a list of dictionaries, and as for `read_content`.
    """
    found = read_content(path)
    if isinstance(found, list):
        raise InputError(f"{path} must be a dictionary, found a list of {len(found)}, as "
                         "DexGraspNet writes it; help: use read_dexgraspnet")
    return found
