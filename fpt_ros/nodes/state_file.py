"""What a node remembers, in a file mapped into memory: it is there when the node is not any more.

Slots are written in turn. Each record carries its number and a checksum, so that one in the middle
of which its writer was killed is known, and the one before it counts. A mapped file needs no call
of the operating system to be written, and what is written stays when the process is killed.
"""

import mmap
import os
import struct
from collections.abc import Iterator
from pathlib import Path
from zlib import crc32

_HEAD = struct.Struct("<8sQQ")
_MAGIC = b"fptstate"
_RECORD = struct.Struct("<12sI")
_NUMBERS = struct.Struct("<QI")
"""Of a record: its number, from 1, and its length; behind them a checksum over all of it."""

_SPARE = 1024
"""Bytes by which a record may grow before the file has to."""


class StateFile:
    """The last ``slots`` records of a process, or of the one before it.

    Args:
        path: of the file, made by the first record.
        slots: two at least.
    """

    def __init__(self, path: Path, slots: int = 2) -> None:
        self._path, self._slots = path, slots
        self._data: mmap.mmap | None = None
        self._size = self._number = 0
        self._open()

    def records(self) -> list[bytes]:
        """The newest record that is whole, and those before it without a gap; oldest first."""
        found = dict(self._whole())
        number = max(found, default=0)
        newest_first: list[bytes] = []
        while number in found:
            newest_first.append(found[number])
            number -= 1
        return newest_first[::-1]

    def add(self, record: bytes) -> None:
        """Write the next record.

        Raises:
            OSError: there is no space for it.
        """
        length = len(record)
        if self._data is None or _RECORD.size + length > self._size:
            self._grow(length)
            assert self._data is not None
        self._number = number = self._number + 1
        at = _HEAD.size + number % self._slots * self._size
        numbers = _NUMBERS.pack(number, length)
        head = _RECORD.pack(numbers, crc32(record, crc32(numbers)))
        self._data[at : at + _RECORD.size + length] = head + record

    def _whole(self) -> Iterator[tuple[int, bytes]]:
        """All records whose checksum is right, by their number."""
        if self._data is None:
            return
        for slot in range(self._slots):
            at = _HEAD.size + slot * self._size
            numbers, crc = _RECORD.unpack_from(self._data, at)
            number, length = _NUMBERS.unpack(numbers)
            if not number or _RECORD.size + length > self._size:
                continue
            record = self._data[at + _RECORD.size : at + _RECORD.size + length]
            if crc == crc32(record, crc32(numbers)):
                yield number, record

    def _open(self) -> None:
        """What is there already, if it is whole."""
        try:
            with self._path.open("r+b") as file:
                data = mmap.mmap(file.fileno(), 0)
        except (OSError, ValueError):
            return
        if len(data) < _HEAD.size:
            return
        magic, size, slots = _HEAD.unpack_from(data)
        if magic != _MAGIC or len(data) != _HEAD.size + size * slots:
            return
        self._data, self._size, self._slots = data, size, slots
        self._number = max((number for number, _ in self._whole()), default=0)

    def _grow(self, length: int) -> None:
        """A new file with larger slots in the place of this one, with the same records.

        Its pages are asked for now: where the disk is full later, a write would kill the process.
        """
        kept, self._size = self.records(), 2 * (_RECORD.size + length) + _SPARE
        size = _HEAD.size + self._slots * self._size
        new = self._path.with_name(self._path.name + ".new")
        descriptor = os.open(new, os.O_RDWR | os.O_CREAT | os.O_TRUNC, 0o600)
        try:
            os.posix_fallocate(descriptor, 0, size)
            self._data = mmap.mmap(descriptor, size)
        finally:
            os.close(descriptor)
        self._data[: _HEAD.size] = _HEAD.pack(_MAGIC, self._size, self._slots)
        self._number -= len(kept)
        for record in kept:
            self.add(record)
        new.replace(self._path)
