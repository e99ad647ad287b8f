"""When a recording goes on in another file: after so many bytes, or so much time."""

import re
from dataclasses import dataclass

from fpt_ros.errors import BadInput
from fpt_ros.messages.frames import SECOND

_UNITS = {
    "kb": 10**3, "mb": 10**6, "gb": 10**9, "kib": 2**10, "mib": 2**20, "gib": 2**30, "b": 1,
}  # fmt: skip
_TIMES = {"s": 1, "min": 60, "h": 3600}
_FORM = re.compile(r"(\d+(?:\.\d+)?)\s*([A-Za-z]+)")
SMALLEST = 64 * 1024


@dataclass(frozen=True)
class Split:
    """After ``size`` bytes of messages, or a ``duration`` [ns]; 0: never."""

    size: int = 0
    duration: int = 0

    @classmethod
    def parse(cls, text: str) -> "Split":
        """Of words like ``100MB`` or ``60s``; an empty one: never.

        Raises:
            BadInput: something else.
        """
        if not text:
            return cls()
        found = _FORM.fullmatch(text.strip())
        if found is not None:
            number, unit = float(found[1]), found[2].lower()
            if unit in _UNITS and number * _UNITS[unit] >= SMALLEST:
                return cls(size=int(number * _UNITS[unit]))
            if unit in _TIMES and number > 0:
                return cls(duration=int(number * _TIMES[unit] * SECOND))
        raise BadInput(
            f"--split {text}: it takes a size from 64KiB on, as in 100MB, or a duration, as in 60s "
            "or 5min"
        )

    def is_due(self, size: int, duration: int) -> bool:
        """Whether a file of this size and duration [ns] is full."""
        return bool(self.size and size >= self.size) or bool(
            self.duration and duration >= self.duration
        )
