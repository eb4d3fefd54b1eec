"""Read the arrays of an NPZ file like numpy.load, without numpy."""

import ast
import struct
import zipfile


def nested(values, shape):
    if not shape:
        return values[0]
    if len(shape) == 1:
        return values
    width = len(values) // shape[0] if shape[0] else 0
    return [nested(values[i * width:(i + 1) * width], shape[1:]) for i in range(shape[0])]


def read_array(data):
    assert data[:8] == b"\x93NUMPY\x01\x00", data[:8]
    length = struct.unpack("<H", data[8:10])[0]
    assert (10 + length) % 64 == 0
    header = ast.literal_eval(data[10:10 + length].decode("ascii"))
    assert not header["fortran_order"]
    kind, body = header["descr"], data[10 + length:]
    if kind == "<f8":
        values = list(struct.unpack(f"<{len(body) // 8}d", body))
    elif kind == "|b1":
        values = [byte != 0 for byte in body]
    else:
        assert kind.startswith("<U"), kind
        width = 4 * int(kind[2:])
        values = [body[i:i + width].decode("utf-32-le").rstrip("\0")
                  for i in range(0, len(body), width)]
    return nested(values, header["shape"])


def read_npz(path):
    """Return the arrays by name; the archive's checksums are checked."""
    with zipfile.ZipFile(path) as archive:
        assert archive.testzip() is None
        return {name.removesuffix(".npy"): read_array(archive.read(name))
                for name in archive.namelist()}
