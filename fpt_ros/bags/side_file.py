"""The messages of the open chunk, in a file beside: what a killed process leaves is not lost.

A chunk goes to the recording when it is full. Until then each of its messages is handed to the
operating system by a call of its own, which keeps it when the process is killed. The side file is
an MCAP file without an end, so whatever reads cut files reads it too.
"""

import os
from pathlib import Path

from fpt_ros.bags.files import SIDE


class SideFile:
    """Holds what the recording ``path`` does not hold yet. All methods may raise OSError."""

    def __init__(self, path: Path, head: bytes, again: bool = False) -> None:
        """``head``: magic and header; ``again``: in the place of one that is not needed any more,
        with its schemas and channels behind the header.
        """
        self._path = path.with_name(path.name + SIDE)
        made = self._path.with_name(self._path.name + ".new") if again else self._path
        how = os.O_WRONLY | os.O_CREAT | os.O_APPEND | (os.O_TRUNC if again else os.O_EXCL)
        self._file = os.open(made, how, 0o666)
        self._head = len(head)
        write_all(self._file, head)
        if again:
            made.replace(self._path)

    def announce(self, records: bytes) -> None:
        """Add schemas and channels, which stay; the chunk has to be empty."""
        write_all(self._file, records)
        self._head += len(records)

    def add(self, record: bytes) -> None:
        """Keep one message."""
        if os.write(self._file, record) != len(record):
            raise OSError(28, os.strerror(28))

    def clear(self) -> None:
        """The chunk is in the recording."""
        os.ftruncate(self._file, self._head)

    def close(self, keep: bool) -> None:
        """Close; ``keep``: the recording does not hold its messages."""
        os.close(self._file)
        if not keep:
            self._path.unlink(missing_ok=True)


def write_all(file: int, data: bytes | memoryview) -> None:
    """Write all of it, or raise OSError."""
    rest = memoryview(data)
    while rest:
        rest = rest[os.write(file, rest) :]
