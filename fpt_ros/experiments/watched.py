"""Vectors that watch what a law does with them, for its trial call."""

import struct
from array import array
from collections.abc import Iterator, MutableSequence, Sequence
from typing import Any

NOT_WRITTEN = struct.unpack("d", struct.pack("Q", 0x7FF8_F970_0000_0001))[0]
"""A NaN that no computation gives: what is still there has not been written."""

GUARD = struct.unpack("d", struct.pack("Q", 0x7FF8_F970_0000_0002))[0]

GUARDS = 8
"""Numbers at either end that nobody may touch; C code may."""


class Misuse(Exception):
    """A law does what it must not do with a vector."""


class Watched(MutableSequence[float]):
    """A vector of a trial call.

    Attributes:
        memory: its numbers, for C functions.
    """

    def __init__(self, name: str, values: Sequence[float], mode: str) -> None:
        """Name it as the law's kind does.

        Args:
            name: for messages.
            values: at the start.
            mode: ``read``: only read; ``keep``: read and written; ``out``: has to be written.
        """
        self._name, self._n, self._mode = name, len(values), mode
        inside = [NOT_WRITTEN] * self._n if mode == "out" else values
        self._whole = array("d", [GUARD] * GUARDS + list(inside) + [GUARD] * GUARDS)
        self._before = self._whole.tobytes()
        self.memory = memoryview(self._whole)[GUARDS : GUARDS + self._n]

    def __len__(self) -> int:
        return self._n

    def __iter__(self) -> Iterator[float]:
        for i in range(self._n):
            yield self[i]

    def __getitem__(self, at: Any) -> Any:
        i = self._place(at, "reads")
        if self._mode == "out" and self._unwritten(i):
            raise Misuse(f"reads {self._name}[{i}] before it writes it: another cycle's is there")
        return self.memory[i]

    def __setitem__(self, at: Any, value: Any) -> None:
        i = self._place(at, "writes")
        if self._mode == "read":
            raise Misuse(f"writes into {self._name}, which is only read")
        if hasattr(value, "__len__") or not hasattr(value, "__float__"):
            raise Misuse(f"writes a {type(value).__name__} into {self._name}[{i}]: only numbers")
        self.memory[i] = float(value)

    def __delitem__(self, at: Any) -> None:
        raise Misuse(f"deletes from {self._name}, whose length is fixed")

    def insert(self, index: int, value: float) -> None:
        """Refused."""
        raise Misuse(f"appends to {self._name}: write {self._name}[i] = ..., its length is fixed")

    def _place(self, at: Any, does: str) -> int:
        if not hasattr(at, "__index__"):
            raise Misuse(f"{does} {self._name}[{at!r}]: vectors are read and written by one index")
        i = at.__index__()
        if not -self._n <= i < self._n:
            has = f"[0] to [{self._n - 1}]" if self._n else "nothing"
            raise Misuse(f"{does} {self._name}[{i}], there is only {has}")
        return int(i) % self._n

    def _unwritten(self, i: int) -> bool:
        return struct.pack("d", self.memory[i]) == struct.pack("d", NOT_WRITTEN)

    def check(self) -> None:
        """After the call.

        Raises:
            Misuse: C wrote where it must not, or what had to be written has not been.
        """
        after, inside = self._whole.tobytes(), slice(8 * GUARDS, 8 * (GUARDS + self._n))
        if self._mode == "read" and after[inside] != self._before[inside]:
            raise Misuse(f"writes into {self._name}, which is only read")
        if after[: inside.start] != self._before[: inside.start]:
            raise Misuse(f"writes before {self._name}[0]")
        if after[inside.stop :] != self._before[inside.stop :]:
            raise Misuse(f"writes beyond {self._name}, which has {self._n} numbers")
        missing = [i for i in range(self._n) if self._mode == "out" and self._unwritten(i)]
        if missing:
            which = ", ".join(f"{self._name}[{i}]" for i in missing)
            raise Misuse(f"never writes {which}: write all {self._n} (NaN where not defined)")
