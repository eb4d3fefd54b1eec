"""Write MCAP files (https://mcap.dev/spec): messages of channels, in indexed chunks."""

from __future__ import annotations

import struct
import zlib

_MAGIC = b"\x89MCAP0\r\n"
_CHUNK_BYTES = 1 << 20
"""Approximate size of a chunk, bytes."""

# Record types.
_HEADER, _FOOTER, _SCHEMA, _CHANNEL, _MESSAGE, _CHUNK, _MESSAGE_INDEX, _CHUNK_INDEX = range(1, 9)
_STATISTICS, _SUMMARY_OFFSET, _DATA_END = 0x0B, 0x0E, 0x0F


def _record(kind: int, content: bytes) -> bytes:
    return struct.pack("<BQ", kind, len(content)) + content


def _bytes(content: bytes) -> bytes:
    return struct.pack("<I", len(content)) + content


def _text(text: str) -> bytes:
    return _bytes(text.encode())


class Writer:
    """Writer that collects messages; `bytes` returns the file.

    Times are in nanoseconds, and messages are added in order. The same messages give the same
    bytes.
    """

    def __init__(self, profile: str, library: str):
        self._data = bytearray(_MAGIC + _record(_HEADER, _text(profile) + _text(library)))
        self._definitions: list[bytes] = []
        self._schemas: dict[str, int] = {}
        self._channels: list[int] = []
        """Number of messages of each channel; channels are numbered from 1."""
        self._chunk = bytearray()
        self._times: list[int] = []
        self._places: dict[int, list[tuple[int, int]]] = {}
        """Times and offsets of each channel's messages in the open chunk."""
        self._chunks: list[bytes] = []
        self._span: tuple[int, int] | None = None

    def channel(self, topic: str, schema: str, definition: str, metadata: dict[str, str]) -> int:
        """Start a channel of ROS 2 messages in CDR, and return its number."""
        if schema not in self._schemas:
            number = len(self._schemas) + 1
            self._schemas[schema] = number
            self._define(_record(_SCHEMA, struct.pack("<H", number) + _text(schema)
                                 + _text("ros2msg") + _text(definition)))
        self._channels.append(0)
        pairs = b"".join(_text(key) + _text(value) for key, value in metadata.items())
        self._define(_record(_CHANNEL, struct.pack("<HH", len(self._channels),
                                                   self._schemas[schema])
                             + _text(topic) + _text("cdr") + _bytes(pairs)))
        return len(self._channels)

    def _define(self, record: bytes) -> None:
        self._definitions.append(record)
        self._chunk += record

    def message(self, channel: int, time: int, content: bytes) -> None:
        """Add a message."""
        self._places.setdefault(channel, []).append((time, len(self._chunk)))
        self._times.append(time)
        self._chunk += _record(_MESSAGE, struct.pack("<HIQQ", channel, self._channels[channel - 1],
                                                     time, time) + content)
        self._channels[channel - 1] += 1
        if len(self._chunk) >= _CHUNK_BYTES:
            self._end_chunk()

    def _end_chunk(self) -> None:
        if not self._times:
            return
        first, last = min(self._times), max(self._times)
        begin = len(self._data)
        self._data += _record(_CHUNK, struct.pack(
            "<QQQI", first, last, len(self._chunk), zlib.crc32(self._chunk)) + _text("")
            + struct.pack("<Q", len(self._chunk)) + self._chunk)
        length = len(self._data) - begin
        indices = b""
        for channel, places in self._places.items():
            indices += struct.pack("<HQ", channel, len(self._data))
            entries = b"".join(struct.pack("<QQ", *place) for place in places)
            self._data += _record(_MESSAGE_INDEX, struct.pack("<H", channel) + _bytes(entries))
        self._chunks.append(_record(_CHUNK_INDEX, struct.pack("<QQQQ", first, last, begin, length)
                                    + _bytes(indices)
                                    + struct.pack("<Q", len(self._data) - begin - length)
                                    + _text("")
                                    + struct.pack("<QQ", len(self._chunk), len(self._chunk))))
        span = self._span or (first, last)
        self._span = min(span[0], first), max(span[1], last)
        self._chunk, self._times, self._places = bytearray(), [], {}

    def bytes(self) -> bytes:
        """Return the content of the file."""
        self._end_chunk()
        data = bytes(self._data)
        if not self._chunks:  # records in the summary must also occur in the data
            data += b"".join(self._definitions)
        data += _record(_DATA_END, struct.pack("<I", zlib.crc32(data)))
        counts = b"".join(struct.pack("<HQ", i, n) for i, n in enumerate(self._channels, 1))
        statistics = _record(_STATISTICS, struct.pack(
            "<QHIIIIQQ", sum(self._channels), len(self._schemas), len(self._channels), 0, 0,
            len(self._chunks), *(self._span or (0, 0))) + _bytes(counts))
        groups = [(_SCHEMA, [r for r in self._definitions if r[0] == _SCHEMA]),
                  (_CHANNEL, [r for r in self._definitions if r[0] == _CHANNEL]),
                  (_STATISTICS, [statistics]), (_CHUNK_INDEX, self._chunks)]
        summary, offsets = b"", b""
        for kind, records in groups:
            group = b"".join(records)
            if group:
                offsets += _record(_SUMMARY_OFFSET, struct.pack("<BQQ", kind, len(data) + len(summary),
                                                                len(group)))
            summary += group
        footer = struct.pack("<BQQQ", _FOOTER, 20, len(data), len(data) + len(summary))
        crc = zlib.crc32(summary + offsets + footer)
        return data + summary + offsets + footer + struct.pack("<I", crc) + _MAGIC
