"""The journal of a sweep: finished rows, a line each, in the order in which they came.

Whatever ends the program, all whole lines count; a line that was cut off is done again.
"""

import fcntl
import json
import os
from array import array
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from types import TracebackType
from typing import Any

from fpt_ros.errors import BadInput
from fpt_ros.sweep.job import Row


class Journal:
    """Rows by their number, on disk; eight bytes a row are kept in memory.

    Attributes:
        done: number of rows.
        lost: rows whose run is not complete.
    """

    def __init__(self, path: Path, size: int, width: int, outcome: int) -> None:
        """Open it, or begin one; what is whole is kept, what is not is cut off.

        Args:
            path: of the file.
            size: rows of the whole sweep.
            width: entries of a row, the first of which is its number.
            outcome: which entry says what became of the run.

        Raises:
            BadInput: it cannot be written, or another sweep is writing it.
        """
        self._size, self._width, self._outcome = size, width, outcome
        self._where = array("q", [-1]) * size
        self.done = self.lost = self._end = 0
        try:
            self._file = path.open("a+b")
        except OSError as error:
            raise BadInput(f"{path} cannot be written: {error.strerror}") from error
        try:
            fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError as error:
            self._file.close()
            raise BadInput(f"{path.parent}: another fpt sweep is writing there") from error
        self._read()

    def __enter__(self) -> "Journal":
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def close(self) -> None:
        """Put it on the disk."""
        if not self._file.closed:
            self._file.flush()
            os.fsync(self._file.fileno())
            self._file.close()

    def __contains__(self, number: int) -> bool:
        return self._where[number] >= 0

    def missing(self) -> Iterator[int]:
        """Numbers that have no row yet, ascending."""
        return (number for number in range(self._size) if self._where[number] < 0)

    @property
    def missing_count(self) -> int:
        """How many have no row yet."""
        return self._size - self.done

    def append(self, rows: Iterable[Row]) -> None:
        """Add rows in one write; one whose number is known already is left out."""
        at, lines = self._end, []
        for row in rows:
            if row[0] in self:
                continue
            line = json.dumps(row, allow_nan=False, separators=(",", ":")).encode() + b"\n"
            self._note(row, at)
            lines.append(line)
            at += len(line)
        self._file.write(b"".join(lines))
        self._file.flush()
        self._end = at

    def rows(self) -> Iterator[Row]:
        """All rows, by their numbers."""
        with open(self._file.name, "rb") as stream:
            for where in self._where:
                if where >= 0:
                    stream.seek(where)
                    yield json.loads(stream.readline())

    def _read(self) -> None:
        self._file.seek(0)
        at = 0
        for line in self._file:
            if not line.endswith(b"\n"):
                break
            row = self._parsed(line)
            if row is not None and row[0] not in self:
                self._note(row, at)
            at += len(line)
        self._file.truncate(at)
        self._file.seek(0, os.SEEK_END)
        self._end = at

    def _parsed(self, line: bytes) -> Sequence[Any] | None:
        try:
            row = json.loads(line)
        except ValueError:
            return None
        whole = isinstance(row, list) and len(row) == self._width and isinstance(row[0], int)
        return row if whole and 0 <= row[0] < self._size else None

    def _note(self, row: Sequence[Any], at: int) -> None:
        self._where[row[0]] = at
        self.done += 1
        self.lost += row[self._outcome] != "complete"
