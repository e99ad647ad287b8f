"""Where the fixed point transformation wins, equals and loses: sentences from the measurements."""

from collections.abc import Sequence
from dataclasses import dataclass

from fpt_ros.compare.field import Circumstance
from fpt_ros.compare.results import Cell, Results

EQUAL = 1.25
"""Errors within this factor of each other are called equal."""

WINS, EQUALS, LOSES, NOBODY = "wins", "equals", "loses", "nobody"
ALONE, BEATEN = "alone", "beaten"
"""``nobody``: none follows; ``alone`` and ``beaten``: only one side does."""


@dataclass(frozen=True)
class Verdict:
    """The best of both families under one circumstance.

    Attributes:
        ours, theirs: the best one with a transformation, and the best without; ``None``: none
            followed the motion.
        kind: for the page's colours.
        text: the sentence.
    """

    circumstance: Circumstance
    ours: Cell | None
    theirs: Cell | None
    kind: str
    text: str


def verdicts(results: Results) -> list[Verdict]:
    """One a circumstance; none where only one family is there."""
    families = {one.family for one in results.asked.plan.field.controllers}
    if len(families) < 2:
        return []
    return [_verdict(results, one) for one in results.asked.plan.field.circumstances]


def _verdict(results: Results, one: Circumstance) -> Verdict:
    cells = [cell for cell in results.of(one) if cell.good]
    limit = results.asked.plan.limit if results.asked.plan.trials else None
    ours, theirs = (
        _best([cell for cell in cells if cell.controller.family is family], limit)
        for family in (True, False)
    )
    if ours is None or theirs is None:
        kind = NOBODY if ours is theirs else BEATEN if ours is None else ALONE
        known = ours or theirs
        text = (
            "no controller follows the motion"
            if known is None
            else f"{_words(known)}; no controller of the other family follows the motion"
        )
        return Verdict(one, ours, theirs, kind, text)
    assert ours.error is not None
    assert theirs.error is not None
    ratio = theirs.error / ours.error if ours.error else float("inf")
    kind = WINS if ratio > EQUAL else LOSES if ratio < 1.0 / EQUAL else EQUALS
    factor = f"{max(ratio, 1.0 / ratio):.3g} times" if kind != EQUALS else "about"
    than = {WINS: "less than", LOSES: "more than", EQUALS: "as much as"}[kind]
    return Verdict(one, ours, theirs, kind, f"{_words(ours)}, {factor} {than} {_words(theirs)}")


def _best(cells: Sequence[Cell], limit: float | None) -> Cell | None:
    """The least error; of those that keep the limit of the tuning, where one does."""
    inside = [c for c in cells if limit is None or (c.step is not None and c.step <= 1.1 * limit)]
    return min(inside or cells, key=lambda cell: cell.error or 0.0, default=None)


def _words(cell: Cell) -> str:
    return f"{cell.controller.name} {cell.error:.2g} (effort steps {cell.step:.2g})"


def front(points: Sequence[Sequence[float]]) -> list[tuple[float, float]]:
    """The Pareto front of (error, step): those that no other one is better than in both."""
    found: list[tuple[float, float]] = []
    for error, step in sorted((float(e), float(s)) for e, s in points):
        if not found or step < found[-1][1]:
            found.append((error, step))
    return found
