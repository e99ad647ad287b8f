"""Times as text: dates with a time of day, times of day alone, and how both are written again."""

import re
from collections.abc import Sequence
from datetime import UTC, datetime

import numpy as np
from numpy.typing import NDArray

Times = NDArray[np.datetime64]
"""(n,) of nanoseconds since 1970; NaT: missing."""

TIME = re.compile(
    r"(?P<date>\d{4}[-/]\d{1,2}[-/]\d{1,2}|\d{1,2}\.\d{1,2}\.\d{4})"
    r"(?:[T _](?P<clock>\d{1,2}:\d{2}(?::\d{2})?)(?:[.,](?P<part>\d{1,12}))?"
    r"\s*(?P<zone>Z|UTC|[+-]\d{2}:?\d{2}|[+-]\d{2})?)?",
    re.ASCII,
)
"""2024-03-01T12:00:10.25Z, 2024/03/01 12:00, 01.03.2024 12:00:10,25. Days between slashes behind
the month, or in front of it, cannot be told apart."""

CLOCK = re.compile(r"(\d{1,3}):(\d{2})(?::(\d{2}))?(?:[.,](\d{1,12}))?", re.ASCII)
"""12:00:10.25, 12:00; with three numbers hours, minutes and seconds."""

PLAIN = re.compile(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d(\.\d{1,9})?", re.ASCII)
"""What numpy reads by itself."""

DAY = 86_400_000_000_000
SECOND = 1_000_000_000


def is_time(cell: str) -> bool:
    """Whether a cell is a date, or a date with a time of day."""
    return bool(TIME.fullmatch(cell)) and not np.isnat(time(cell)[0])


def is_clock(cell: str) -> bool:
    """Whether a cell is a time of day."""
    return bool(CLOCK.fullmatch(cell))


def time(cell: str) -> tuple[np.datetime64, bool]:
    """A cell as a time, and whether it names its zone; NaT if it is none."""
    match = TIME.fullmatch(cell.strip())
    if match is None:
        return np.datetime64("NaT", "ns"), False
    date, clock, part, zone = match.group("date", "clock", "part", "zone")
    pieces = [int(x) for x in re.split(r"[-/.]", date)]
    year, month, day = pieces if pieces[0] > 31 else pieces[::-1]
    hours, minutes, seconds = ([int(x) for x in (clock or "0:0").split(":")] + [0])[:3]
    try:
        moment = datetime(year, month, day, hours, minutes, min(seconds, 59), tzinfo=UTC)
    except ValueError:
        return np.datetime64("NaT", "ns"), False
    ns = int(moment.timestamp()) * SECOND + (seconds - min(seconds, 59)) * SECOND
    ns += int((part or "0").ljust(9, "0")[:9]) - _offset(zone)
    return np.datetime64(ns, "ns"), zone is not None


def _offset(zone: str | None) -> int:
    """Of a zone from UTC [ns]."""
    if zone in (None, "Z", "UTC"):
        return 0
    digits = zone[1:].replace(":", "")
    minutes = int(digits[:2]) * 60 + int(digits[2:] or "0")
    return (-minutes if zone[0] == "-" else minutes) * 60 * SECOND


def times(cells: Sequence[str]) -> tuple[Times, bool]:
    """Cells as times, NaT where one is none, and whether they name a zone."""
    text = [cell.strip() for cell in cells]
    bare = [cell.removesuffix("Z") for cell in text]
    if all(map(PLAIN.fullmatch, bare)):
        try:
            return np.array(bare, dtype="datetime64[ns]"), len(bare[0]) < len(text[0])
        except ValueError:
            pass
    found = [time(cell) for cell in text]
    return np.array([moment for moment, _ in found], "datetime64[ns]"), any(z for _, z in found)


def clocks(cells: Sequence[str]) -> NDArray[np.timedelta64]:
    """Cells as times of day, NaT where one is none."""
    return np.array([_clock(cell) for cell in cells], "timedelta64[ns]")


def _clock(cell: str) -> np.timedelta64:
    match = CLOCK.fullmatch(cell.strip())
    if match is None:
        return np.timedelta64("NaT", "ns")
    hours, minutes, seconds, part = match.groups()
    whole = int(hours) * 3600 + int(minutes) * 60 + int(seconds or 0)
    return np.timedelta64(whole * SECOND + int((part or "0").ljust(9, "0")[:9]), "ns")


def over_midnight(clock: NDArray[np.timedelta64]) -> NDArray[np.timedelta64]:
    """Times of day that go on behind midnight instead of beginning again."""
    ns = clock.astype(np.int64)
    known = np.flatnonzero(~np.isnat(clock))
    days = np.zeros(len(ns), dtype=np.int64)
    step = np.diff(ns[known])
    days[known[1:]] = np.cumsum((step < -DAY // 2).astype(np.int64) - (step > DAY // 2))
    return np.where(np.isnat(clock), clock, (ns + days * DAY).astype("timedelta64[ns]"))


def text(values: NDArray[np.datetime64] | NDArray[np.timedelta64], zone: str = "") -> list[str]:
    """Times as ISO 8601 with no more digits than needed, times of day as hh:mm:ss.

    Args:
        values: (n,) datetime64[ns] or timedelta64[ns].
        zone: ``UTC`` for a Z at the end.
    """
    daily = values.dtype.kind == "m"
    nat = np.isnat(values)
    ns = values.astype(np.int64)
    if daily:
        ns = ns % DAY
    known = ns[~nat]
    unit = next((u for u, size in UNITS if not np.any(known % size)), "ns")
    found = np.datetime_as_string(ns.astype("datetime64[ns]"), unit=unit)  # type: ignore[call-overload]
    tail = "Z" if zone and not daily else ""
    return [
        "" if lost else (word[11:] if daily else word + tail)
        for word, lost in zip(found.tolist(), nat.tolist(), strict=True)
    ]


UNITS = (("s", SECOND), ("ms", 1_000_000), ("us", 1_000))
"""Of numpy, with their lengths [ns]."""
