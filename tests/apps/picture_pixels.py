"""Content of the images that validate writes: pixels, the red of faults, durations."""

import struct
import zlib


def png_size(data):
    """Return width and height of a PNG."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    return struct.unpack(">II", data[16:24])


def png_rows(data):
    """Return the pixel rows of a PNG with 8 bits per channel, as filtered bytes."""
    width, height = png_size(data)
    assert data[24] == 8 and data[25] in (2, 6), "RGB or RGBA"
    packed, at = b"", 8
    while at < len(data):
        length = struct.unpack(">I", data[at:at + 4])[0]
        if data[at + 4:at + 8] == b"IDAT":
            packed += data[at + 8:at + 8 + length]
        at += length + 12
    stride = 1 + width * (3 if data[25] == 2 else 4)
    raw = zlib.decompress(packed)
    assert len(raw) == stride * height
    return [raw[y * stride:(y + 1) * stride] for y in range(height)]


def png_pixels(data):
    """Return rows of RGB triples of a PNG with 8 bits per channel, without transparency and
    interlacing."""
    assert data[25] == 2, "RGB"
    filtered = png_rows(data)
    stride = len(filtered[0]) - 1
    before, rows = bytearray(stride), []
    for line in filtered:
        kind = line[0]
        row = bytearray(line[1:])
        for i in range(stride):
            left = row[i - 3] if i >= 3 else 0
            corner = before[i - 3] if i >= 3 else 0
            if kind == 1:
                add = left
            elif kind == 2:
                add = before[i]
            elif kind == 3:
                add = (left + before[i]) // 2
            elif kind == 4:
                guess = left + before[i] - corner
                ways = (abs(guess - left), abs(guess - before[i]), abs(guess - corner))
                add = (left, before[i], corner)[ways.index(min(ways))]
            else:
                add = 0
            row[i] = (row[i] + add) & 255
        rows.append([tuple(row[i:i + 3]) for i in range(0, stride, 3)])
        before = row
    return rows


def count(rows, holds):
    return sum(holds(pixel) for row in rows for pixel in row)


def is_red(pixel):
    """Return True for the red of faults, lit or shaded; no finger has this colour."""
    red, green, blue = pixel
    return red > 110 and green < 0.22 * red and blue < 0.35 * red


def webp_durations(data):
    """Return the duration of each frame of an animated WebP, ms."""
    assert data[:4] == b"RIFF" and data[8:12] == b"WEBP"
    at, durations = 12, []
    while at < len(data):
        size = int.from_bytes(data[at + 4:at + 8], "little")
        if data[at:at + 4] == b"ANMF":
            durations.append(int.from_bytes(data[at + 20:at + 23], "little"))
        at += 8 + size + size % 2
    return durations
