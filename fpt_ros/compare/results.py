"""What came of a comparison, looked at by controller and circumstance."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from fpt_ros.compare.compare import Comparison
from fpt_ros.compare.field import Circumstance, Controller, variant
from fpt_ros.sweep.job import COMPLETE

FOLLOWS = 0.5
"""An error of this part of the nominal motion's own deviation: the motion is not followed."""

CHATTERS = 20.0
"""Efforts whose steps are so many times the limit of the tuning chatter."""

LATE = 0.02
"""Part of the cycles in which efforts may be cut before it is mentioned."""


@dataclass(frozen=True)
class Cell:
    """One controller under one circumstance; numbers are ``None`` where there are none."""

    controller: Controller
    circumstance: Circumstance
    outcome: str
    reason: str
    error: float | None
    max: float | None
    effort: float | None
    step: float | None
    cut: float | None
    cost: float | None
    time: Sequence[float]
    errors: Sequence[float | None]
    verdict: str

    @property
    def good(self) -> bool:
        """Whether it came to its end and followed the motion."""
        return not self.verdict and self.error is not None

    @property
    def variant(self) -> str:
        """What ``--variant`` takes."""
        return variant(self.controller, self.circumstance)


@dataclass(frozen=True)
class Tuning:
    """What was tried and found for a controller in a group of circumstances."""

    controller: Controller
    circumstance: Circumstance
    before: Mapping[str, float]
    ranges: Mapping[str, Sequence[float]]
    found: Mapping[str, float]
    reason: str
    trials: Sequence[Sequence[float]]


@dataclass(frozen=True)
class Results:
    """All of it.

    Attributes:
        cells: by names of controller and circumstance.
        tunings: by the same, of the first circumstance of each group.
    """

    asked: Comparison
    cells: Mapping[tuple[str, str], Cell]
    tunings: Mapping[tuple[str, str], Tuning]

    @property
    def ranked(self) -> list[Controller]:
        """Controllers, the least error in the experiment as it is first."""
        first = self.asked.plan.field.circumstances[0].name

        def key(one: Controller) -> tuple[bool, float]:
            cell = self.cells[one.name, first]
            return not cell.good, cell.error if cell.error is not None else float("inf")

        return sorted(self.asked.plan.field.controllers, key=key)

    def of(self, circumstance: Circumstance) -> list[Cell]:
        """All controllers under a circumstance, in their order."""
        return [self.cells[one.name, circumstance.name] for one in self.ranked]


def results_of(asked: Comparison, rows: Sequence[Mapping[str, Any]]) -> Results:
    """Read the rows of all tasks."""
    cells, tunings = {}, {}
    for (controller, group), row in zip(asked.plan.tasks, rows, strict=True):
        for one in group:
            cells[controller.name, one.name] = _cell(
                controller, one, row["runs"][one.name], asked.plan.limit
            )
        tuned = row["tuning"]
        if tuned:
            tunings[controller.name, group[0].name] = Tuning(
                controller,
                group[0],
                tuned["before"],
                tuned["ranges"],
                tuned["found"],
                tuned["reason"],
                tuned["trials"],
            )
    return Results(asked, cells, tunings)


def _cell(controller: Controller, one: Circumstance, run: Mapping[str, Any], limit: float) -> Cell:
    numbers = {key: run.get(key) for key in ("error", "max", "effort", "step", "cut", "cost")}
    return Cell(
        controller=controller,
        circumstance=one,
        outcome=run["outcome"],
        reason=run["reason"],
        time=run.get("time", ()),
        errors=run.get("errors", ()),
        verdict=_verdict(run, limit),
        **numbers,
    )


def _verdict(run: Mapping[str, Any], limit: float) -> str:
    """How it failed, in words; empty where it did not."""
    if run["outcome"] != COMPLETE:
        return str(run["reason"])
    error, step, deviation = run["error"], run["step"], run["deviation"]
    if error is None:
        return "its error is not a number"
    if deviation and error > FOLLOWS * deviation:
        cut = run["cut"] or 0.0
        why = f", efforts cut in {100.0 * cut:.0f} % of the cycles" if cut > LATE else ""
        return f"does not follow: an error of {error:.2g} on a motion of {deviation:.2g}{why}"
    if step is not None and step > CHATTERS * limit:
        return f"chatters: efforts step by {step:.2g} a cycle on average"
    return ""
