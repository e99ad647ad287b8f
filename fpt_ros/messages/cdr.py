"""Frames to CDR bytes and back, without message objects.

Once the names are known, a loop message has a fixed layout: the stamp stands at byte 4, and each
array of doubles at an offset that never changes. A :class:`Codec` works a layout out once, keeps
it, and from then on packs and unpacks numbers in place. Bytes of another layout (another set of
names, as in time sharing, or another endianness) are parsed in full; for decoding the layout met
last is kept, for encoding all of them.
"""

import struct
from collections.abc import Sequence
from operator import itemgetter
from typing import Any

from fpt_ros.messages.frames import SECOND, Frame, Names
from fpt_ros.messages.topics import JOINT_TRAJECTORY, MESSAGE_FIELDS, Topic

_HEADER = 4
"""Encapsulation bytes in front; alignment counts from behind them."""


class MalformedMessage(ValueError):
    """Bytes that are not a message of the topic's type."""


class _Layout:
    """Where the numbers of one message layout stand.

    Attributes:
        names: of the frame.
        whole: the message: seconds, nanoseconds, and in turn bytes that never change and vectors.
        places: from where to where, among the message's values, each of the frame's vectors stands.
    """

    def __init__(
        self,
        names: Names,
        whole: struct.Struct,
        fixed: Sequence[tuple[int, bytes]],
        places: Sequence[tuple[int, int]],
    ) -> None:
        """``fixed``: (place among the message's values, the bytes there)."""
        self.names = names
        self.whole = whole
        self.places = places
        self._fixed = fixed
        # with an empty slice at the end a getter always gives a tuple
        self._get = itemgetter(*[slice(*each) for each in places], slice(0))
        self._get_fixed = itemgetter(*[at for at, _ in fixed], slice(0))
        self._same = (*[raw for _, raw in fixed], ())

    def read(self, data: bytes) -> tuple[Any, ...] | None:
        """The message's values; None: it has another layout."""
        if len(data) != self.whole.size:
            return None
        values = self.whole.unpack(data)
        return values if self._get_fixed(values) == self._same else None

    def vectors(self, values: tuple[Any, ...]) -> tuple[tuple[float, ...], ...]:
        """The frame's vectors among the message's values."""
        vectors: tuple[tuple[float, ...], ...] = self._get(values)[:-1]
        return vectors

    def blank(self) -> list[Any]:
        """The message's values with the numbers still to be filled in."""
        values: list[Any] = list(self.whole.unpack(bytes(self.whole.size)))
        for at, raw in self._fixed:
            values[at] = raw
        return values


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
        self._encoders: dict[tuple[Names, tuple[int, ...]], _Layout] = {}
        self._last_key: tuple[Names, tuple[int, ...]] | None = None
        self._last: _Layout | None = None
        self._values: list[Any] = []
        self._decoder: _Layout | None = None

    def encode(self, frame: Frame) -> bytes:
        """CDR of a frame (little endian, XCDR1, as Fast DDS writes it)."""
        stamp, names = frame[0], frame[1]
        vectors = frame[2:]
        key = (names, tuple(map(len, vectors)))
        if key != self._last_key:
            layout = self._encoders.get(key)
            if layout is None:
                layout = self._encoders[key] = self._build(names, key[1])
            self._last_key, self._last, self._values = key, layout, layout.blank()
        assert self._last is not None
        layout, values = self._last, self._values
        values[1], values[2] = divmod(stamp, SECOND)
        for (start, end), vector in zip(layout.places, vectors, strict=True):
            values[start:end] = vector
        return layout.whole.pack(*values)

    def decode(self, data: bytes) -> Frame:
        """Frame of CDR bytes.

        Raises:
            MalformedMessage: the bytes are cut or not of this type.
        """
        layout = self._decoder
        values = layout.read(data) if layout is not None else None
        if layout is None or values is None:
            layout = self._decoder = self._parse(data)
            values = layout.whole.unpack(data)
        stamp = values[1] * SECOND + values[2]
        return self._make(stamp, layout.names, *layout.vectors(values))

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
        form, size, since = f"{order}{_HEADER}siI", 3, _HEADER + 8
        fixed: list[tuple[int, bytes]] = [(0, data[:_HEADER])]
        arrays: list[tuple[int, int]] = []

        def keep(end: int) -> None:
            """The bytes from the last vector up to ``end`` never change."""
            nonlocal form, size, since
            if end > since:
                fixed.append((size, data[since:end]))
                form, size = f"{form}{end - since}s", size + 1
            since = end

        for _ in self._fields:
            length = word()
            if not length:
                arrays.append((0, 0))
                continue
            at += -(at - _HEADER) % 8
            keep(at)
            if at + 8 * length > len(data):
                raise IndexError
            arrays.append((size, size + length))
            form, size = f"{form}{length}d", size + length
            at = since = at + 8 * length
        if self._trajectory:
            struct.unpack_from(order + "iI", data, at + -(at - _HEADER) % 4)
        keep(at)
        return _Layout(
            names=names,
            whole=struct.Struct(f"{form}{len(data) - since}x"),
            fixed=fixed,
            places=[arrays[slot] for slot in self._slots],
        )
