"""Where the numbers of a serialised message stand, of any ROS 2 type.

Messages of one topic mostly have one layout: the same names, lengths and words, other numbers. The
definition of the type is followed once, through one message; all others with the same bytes where
lengths and words stand are read by numpy, thousands at a time.
"""

import struct
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from rosbags.interfaces import Nodetype

Definitions = Mapping[str, tuple[Any, Sequence[tuple[str, Any]]]]
"""Fields by type, as rosbags parses them."""

Bytes = NDArray[np.uint8]

_SIZES = {
    "bool": "u1", "byte": "u1", "char": "u1", "octet": "u1", "uint8": "u1", "int8": "i1",
    "uint16": "u2", "int16": "i2", "uint32": "u4", "int32": "i4", "uint64": "u8", "int64": "i8",
    "float32": "f4", "float64": "f8",
}  # fmt: skip
_PLACEHOLDER = "structure_needs_at_least_one_member"


class Malformed(ValueError):
    """Bytes that are not a message of the type."""


class Leaf(NamedTuple):
    """Numbers: ``length`` of them in a row from byte ``at`` on; None: one that is no array."""

    path: str
    at: int
    dtype: str
    length: int | None
    is_bool: bool


class Layout:
    """One layout of a type's messages.

    Attributes:
        size: bytes of a message.
        leaves: where numbers stand.
        texts: words, by path; the same in all messages of this layout.
    """

    def __init__(
        self,
        data: bytes,
        leaves: Sequence[Leaf],
        texts: Mapping[str, str],
        fixed: Sequence[tuple[int, int]],
    ) -> None:
        """``fixed``: first byte and byte behind the last of what never changes."""
        self.size = len(data)
        self.leaves, self.texts = tuple(leaves), dict(texts)
        # padding is not among them: its bytes are not defined
        self._fixed = np.concatenate([np.arange(*each) for each in fixed])
        self._same = np.frombuffer(data, dtype=np.uint8)[self._fixed]

    def fits(self, messages: Bytes) -> NDArray[np.bool_]:
        """Which of the messages (n, size) have this layout."""
        found: NDArray[np.bool_] = (messages[:, self._fixed] == self._same).all(axis=1)
        return found

    def numbers(self, messages: Bytes, leaf: Leaf) -> NDArray[Any]:
        """(n, count) numbers of messages (n, size); of a single number (n, 1)."""
        width = (leaf.length if leaf.length is not None else 1) * int(leaf.dtype[-1])
        part = np.ascontiguousarray(messages[:, leaf.at : leaf.at + width])
        return part.view(leaf.dtype).reshape(len(messages), -1)


def layout(type: str, definitions: Definitions, data: bytes) -> Layout:
    """The layout of one message.

    Raises:
        Malformed: it is not of this type.
    """
    walk = _Walk(definitions, data)
    try:
        walk.fields(type, "")
    except (struct.error, IndexError, UnicodeDecodeError, RecursionError) as error:
        raise Malformed(f"{len(data)} bytes are not a {type}") from error
    except KeyError as error:
        raise Malformed(f"the definition of {error.args[0]} is not there") from error
    if walk.at > len(data):
        raise Malformed(f"{len(data)} bytes are not a {type}")
    return Layout(data, walk.leaves, walk.texts, walk.fixed)


class _Walk:
    """Follows a definition through the bytes of a message."""

    def __init__(self, definitions: Definitions, data: bytes) -> None:
        if len(data) < 4 or data[0] or data[1] not in (0, 1, 6, 7):
            raise Malformed("it does not begin as CDR")
        self._definitions, self._data = definitions, data
        self._order = "<" if data[1] & 1 else ">"
        self._largest = 4 if data[1] > 1 else 8  # alignment in XCDR2 and XCDR1
        self.at = 4
        self.leaves: list[Leaf] = []
        self.texts: dict[str, str] = {}
        self.fixed = [(0, 4)]

    def fields(self, type: str, path: str) -> None:
        """All fields of a type, in turn."""
        for name, (kind, about) in self._definitions[type][1]:
            self._field(kind, about, f"{path}.{name}" if path else name)

    def _field(self, kind: Nodetype, about: Any, path: str) -> None:
        if kind == Nodetype.BASE:
            self._base(about[0], path)
        elif kind == Nodetype.NAME:
            self.fields(about, path)
        elif kind == Nodetype.ARRAY:
            self._elements(about[0], about[1], path)
        else:
            self._elements(about[0], self._word(), path)

    def _base(self, name: str, path: str) -> None:
        if name == "string":
            self.texts[path] = self._text()
        elif path.endswith(_PLACEHOLDER):
            self.at += 1
        else:
            self._numbers(name, None, path)

    def _elements(self, element: Any, count: int, path: str) -> None:
        kind, about = element
        if count > len(self._data):
            raise IndexError
        if kind == Nodetype.BASE and about[0] != "string":
            self._numbers(about[0], count, path)
            return
        for i in range(count):
            self._field(kind, about, f"{path}[{i}]")

    def _numbers(self, name: str, count: int | None, path: str) -> None:
        if name not in _SIZES:
            raise Malformed(f"{path} is a {name}, which is not read here")
        dtype = self._order + _SIZES[name]
        size = int(dtype[-1])
        if count != 0:
            self._align(size)
        self.leaves.append(Leaf(path, self.at, dtype, count, name == "bool"))
        self.at += size * (1 if count is None else count)
        if self.at > len(self._data):
            raise IndexError

    def _align(self, size: int) -> None:
        self.at += -(self.at - 4) % min(size, self._largest)

    def _word(self) -> int:
        self._align(4)
        (value,) = struct.unpack_from(self._order + "I", self._data, self.at)
        self.fixed.append((self.at, self.at + 4))
        self.at += 4
        return int(value)

    def _text(self) -> str:
        length = self._word()
        raw = self._data[self.at : self.at + length]
        if len(raw) != length or (raw and raw[-1]):
            raise IndexError
        self.fixed.append((self.at, self.at + length))
        self.at += length
        return raw[:-1].decode()
