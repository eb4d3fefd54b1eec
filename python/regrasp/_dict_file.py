"""Reads dictionaries that numpy.save pickles, and NPZ files, and executes nothing in them."""

from __future__ import annotations

import pickle
import pickletools
import zipfile

import numpy as np

from . import _arguments
from ._regrasp import InputError


class _Array:
    """Stands for numpy.ndarray, which as a function would take memory of any size."""


def _reconstruct(kind, shape, dtype):
    """An array before its content, as NumPy pickles one."""
    if kind is not _Array or shape != (0,):
        raise InputError("contains an array that NumPy did not write")
    return np.core.multiarray._reconstruct(np.ndarray, shape, dtype)


# What arrays and numbers of NumPy are made of when they are unpickled; nothing else is looked up.
_ARRAY_PARTS = {
    ("numpy", "ndarray"): _Array,
    ("numpy", "dtype"): np.dtype,
    ("numpy.core.multiarray", "_reconstruct"): _reconstruct,
    ("numpy._core.multiarray", "_reconstruct"): _reconstruct,
    ("numpy.core.multiarray", "scalar"): np.core.multiarray.scalar,
    ("numpy._core.multiarray", "scalar"): np.core.multiarray.scalar,
}


# Of a pickle: what makes objects of classes, refers to something outside of it, or shares memory.
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
    """What an NPY file holds; of objects, what was pickled."""
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
    """The dictionary of an NPY file, or the members of an NPZ file as one."""
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
    """Not an array, where it is one of a single object."""
    return value.item() if isinstance(value, np.ndarray) and value.shape == () else value


def read_content(path) -> dict | list[dict]:
    """The dictionary of an NPY file that numpy.save wrote of it, the arrays of an NPZ file, or the
    dictionaries of an NPY file of an array or a list of them.

    Raises:
        InputError: it is none, or holds something else than dictionaries, lists, texts, numbers
            and arrays of NumPy.
    """
    try:
        found = _plain(_content(path))
    except OSError as error:
        raise InputError(f"{path}: {error.strerror or error}") from None
    except InputError as error:
        raise InputError(f"{path}: {error}") from None
    except Exception as error:  # what a pickle that is cut off or made up brings about
        raise InputError(f"{path}: not a NumPy dictionary file: {error}".replace("\n", " ")) from None
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
    """The same, if it is a single dictionary.

    Raises:
        InputError: it is a list of dictionaries, or as `read_content`.
    """
    found = read_content(path)
    if isinstance(found, list):
        raise InputError(f"{path} must be a dictionary, found a list of {len(found)}, as "
                         "DexGraspNet writes it; help: use read_dexgraspnet")
    return found
