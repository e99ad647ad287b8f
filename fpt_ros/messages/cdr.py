"""Frames to CDR bytes and back, without message objects.

Once the names are known, a loop message has a fixed layout: the stamp stands at byte 4, and each
array of doubles at an offset that never changes. A :class:`Codec` works a layout out once, keeps
it, and from then on packs and unpacks numbers in place. Bytes of another layout (another set of
names, as in time sharing, or another endianness) are parsed in full; for decoding the layout met
last is kept, for encoding all of them.
"""

import struct
from dataclasses import dataclass

from fpt_ros.messages.frames import SECOND, Frame, Names
from fpt_ros.messages.topics import JOINT_TRAJECTORY, MESSAGE_FIELDS, Topic

_HEADER = 4
"""Encapsulation bytes in front; alignment counts from behind them."""


class MalformedMessage(ValueError):
    """Bytes that are not a message of the topic's type."""


@dataclass(frozen=True)
class _Layout:
    """Where the numbers of one message layout stand."""

    template: bytes
    names: Names
    stamp: struct.Struct
    arrays: tuple[tuple[struct.Struct, int], ...]
    """(packer, offset) of each of the frame's vectors."""
    fixed: tuple[tuple[int, int], ...]
    """Byte ranges that are the same in all messages of this layout."""

    def matches(self, data: bytes) -> bool:
        template = self.template
        if len(data) != len(template):
            return False
        return all(data[a:b] == template[a:b] for a, b in self.fixed)


class Codec:
    """Encodes and decodes the frames of one topic.

    Not shared between threads: it keeps the layout that it met last.
    """

    def __init__(self, topic: Topic) -> None:
        self.topic = topic
        self._fields = MESSAGE_FIELDS[topic.type]
        self._trajectory = topic.type == JOINT_TRAJECTORY
        self._slots = tuple(self._fields.index(name) for name in topic.fields)
        self._make = topic.frame
        self._encoders: dict[tuple[Names, tuple[int, ...]], tuple[_Layout, bytearray]] = {}
        self._last_key: tuple[Names, tuple[int, ...]] | None = None
        self._last: tuple[_Layout, bytearray] | None = None
        self._decoder: _Layout | None = None

    def encode(self, frame: Frame) -> bytes:
        """CDR of a frame (little endian, XCDR1, as Fast DDS writes it)."""
        stamp, names = frame[0], frame[1]
        vectors = frame[2:]
        key = (names, tuple([len(vector) for vector in vectors]))
        if key != self._last_key or self._last is None:
            if key not in self._encoders:
                layout = self._build(names, key[1])
                self._encoders[key] = layout, bytearray(layout.template)
            self._last_key, self._last = key, self._encoders[key]
        layout, buffer = self._last
        layout.stamp.pack_into(buffer, _HEADER, *divmod(stamp, SECOND))
        for (packer, offset), vector in zip(layout.arrays, vectors, strict=True):
            packer.pack_into(buffer, offset, *vector)
        return bytes(buffer)

    def decode(self, data: bytes) -> Frame:
        """Frame of CDR bytes.

        Raises:
            MalformedMessage: the bytes are cut or not of this type.
        """
        layout = self._decoder
        if layout is None or not layout.matches(data):
            layout = self._decoder = self._parse(data)
        seconds, nanoseconds = layout.stamp.unpack_from(data, _HEADER)
        vectors = [packer.unpack_from(data, offset) for packer, offset in layout.arrays]
        return self._make(seconds * SECOND + nanoseconds, layout.names, *vectors)

    def _build(self, names: Names, lengths: tuple[int, ...]) -> _Layout:
        """Layout of a message with these names, its frame's vectors of these lengths."""
        sizes = dict(zip(self._slots, lengths, strict=True))
        out = bytearray(b"\x00\x01\x00\x00")

        def align(size: int) -> None:
            out.extend(bytes(-(len(out) - _HEADER) % size))

        def word(value: int) -> None:
            align(4)
            out.extend(struct.pack("<I", value))

        def text(value: str) -> None:
            raw = value.encode() + b"\0"
            word(len(raw))
            out.extend(raw)

        out.extend(bytes(8))  # stamp
        text("")  # frame_id
        word(len(names))
        for name in names:
            text(name)
        if self._trajectory:
            word(1)  # one point
        for slot in range(len(self._fields)):
            size = sizes.get(slot, 0)
            word(size)
            if size:
                align(8)
                out.extend(bytes(8 * size))
        if self._trajectory:
            align(4)
            out.extend(bytes(8))  # time_from_start
        return self._parse(bytes(out))

    def _parse(self, data: bytes) -> _Layout:
        """Work out the layout of a whole message."""
        try:
            return self._parse_or_raise(data)
        except (struct.error, IndexError, UnicodeDecodeError) as error:
            raise MalformedMessage(
                f"{self.topic.name}: {len(data)} bytes are not a {self.topic.type}"
            ) from error

    def _parse_or_raise(self, data: bytes) -> _Layout:
        order = "<" if data[1] == 1 else ">"
        at = _HEADER + 8

        def word() -> int:
            nonlocal at
            at += -(at - _HEADER) % 4
            (value,) = struct.unpack_from(order + "I", data, at)
            at += 4
            return int(value)

        def text() -> str:
            nonlocal at
            length = word()
            raw = data[at : at + length]
            if len(raw) != length or not raw.endswith(b"\0"):
                raise IndexError
            at += length
            return raw[:-1].decode()

        text()
        names = tuple(text() for _ in range(min(word(), len(data))))
        if self._trajectory and word() != 1:
            raise IndexError
        fixed_from, fixed = _HEADER + 8, []
        arrays: list[tuple[struct.Struct, int]] = []
        for _ in self._fields:
            length = word()
            if length:
                at += -(at - _HEADER) % 8
                fixed.append((fixed_from, at))
            packer = struct.Struct(f"{order}{min(length, len(data))}d")
            packer.unpack_from(data, at)
            arrays.append((packer, at))
            at += 8 * length
            if length:
                fixed_from = at
        if self._trajectory:
            struct.unpack_from(order + "iI", data, at + -(at - _HEADER) % 4)
        else:
            fixed.append((fixed_from, at))
        return _Layout(
            template=data,
            names=names,
            stamp=struct.Struct(order + "iI"),
            arrays=tuple(arrays[slot] for slot in self._slots),
            fixed=((0, _HEADER), *((a, b) for a, b in fixed if b > a)),
        )
