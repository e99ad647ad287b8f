"""The numbers of several runs side by side."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import cast

from fpt_ros.analysis.metrics import Summary
from fpt_ros.analysis.sizes import finite

TRACKING = ("rms_settled", "max_settled", "rms")
"""Quantities of ``tracking`` that :func:`comparison` lists, the most telling first."""

PERFORMANCE = ("iae", "ise", "itae", "rise_time", "settling_time", "overshoot_percent")
"""Those of ``performance``, which only a report has."""

REAL_TIME = ("missed_deadlines", "latency_median_ms", "latency_p99_ms", "latency_max_ms")
"""Quantities of ``real_time`` that :func:`comparison` lists."""


@dataclass(frozen=True)
class Row:
    """One quantity of several runs.

    Attributes:
        coordinate: whose; empty for what is of all.
        quantity: one of :data:`TRACKING` and :data:`PERFORMANCE`, ``effort`` (its rms),
            ``energy``, ``chatter``, or one of :data:`REAL_TIME`.
        values: one a run; ``None`` where a run has none.
        ratios: each value over that of the run it is measured against (:func:`baselines`); none
            of what depends on the machine.
    """

    coordinate: str
    quantity: str
    values: tuple[float | None, ...]
    ratios: tuple[float | None, ...]


def baselines(summaries: Sequence[Summary]) -> list[int]:
    """For each run the index of the one it is measured against.

    It is the first run of the same experiment that does not adapt at all (no transformation, no
    tuner); where there is none, the first run of the same experiment.
    """
    found = []
    for one in summaries:
        same = [i for i, s in enumerate(summaries) if s["experiment"] == one["experiment"]]
        still = [i for i in same if not summaries[i].get("adaptive", True)]
        found.append((still or same)[0])
    return found


def comparison(summaries: Sequence[Summary]) -> list[Row]:
    """Runs side by side: errors and effort of each coordinate, the controlled first; chatter;
    what those in real time say of their deadlines.
    """
    rows = []
    tracked = _names(summaries, "tracking")
    for name in dict.fromkeys([*tracked, *_names(summaries, "effort")]):
        for key in TRACKING if name in tracked else ():
            errors = [_entry(s, "tracking", name, key) for s in summaries]
            rows.append(_row(summaries, name, key, errors))
        for key in PERFORMANCE:
            numbers = [_entry(s, "performance", name, key) for s in summaries]
            if any(number is not None for number in numbers):
                rows.append(_row(summaries, name, key, numbers))
        for key, part, inner in (("effort", "effort", "rms"), ("energy", "performance", "energy")):
            efforts = [_entry(s, part, name, inner) for s in summaries]
            if any(efforts):  # a force that is zero by construction says nothing
                rows.append(_row(summaries, name, key, efforts))
    chatter = [cast("float | None", s.get("chatter")) for s in summaries]
    rows.append(_row(summaries, "", "chatter", chatter))
    for key in REAL_TIME:
        timings = tuple(_timing(s).get(key) for s in summaries)
        if any(value is not None for value in timings):
            rows.append(Row("", key, timings, (None,) * len(timings)))
    return rows


def _timing(one: Summary) -> Mapping[str, float | None]:
    return cast("Mapping[str, float | None]", one.get("real_time") or {})


def _names(summaries: Sequence[Summary], part: str) -> list[str]:
    """Coordinates of all runs, each once, in the order in which they are met."""
    return list(dict.fromkeys(name for s in summaries for name in _part(s, part)))


def _part(one: Summary, part: str) -> Mapping[str, Mapping[str, float | None]]:
    return cast("Mapping[str, Mapping[str, float | None]]", one.get(part) or {})


def _entry(one: Summary, part: str, name: str, key: str) -> float | None:
    return _part(one, part).get(name, {}).get(key)


def _row(summaries: Sequence[Summary], name: str, key: str, values: Sequence[float | None]) -> Row:
    against = [values[i] for i in baselines(summaries)]
    ratios = tuple(
        None if value is None or not base else finite(value / base)
        for value, base in zip(values, against, strict=True)
    )
    return Row(name, key, tuple(values), ratios)
