"""The claims of the thesis, one a block, each judged by what was measured for it.

A chapter is a module ``chapterN`` in this folder with ``TITLE`` and ``CLAIMS``; it is found by its
name. A claim names what it needs, runs of experiments (:class:`Setup`) or trials of denoisers
(:class:`~fpt_ros.thesis.trials.Trial`); a pure function judges them, and its pictures draw
them.
"""

import re
import shlex
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from importlib import import_module
from pkgutil import iter_modules
from typing import Any, Generic, Protocol, TypeVar

from matplotlib.figure import Figure

from fpt_ros import thesis
from fpt_ros.errors import RunFailed
from fpt_ros.experiments.experiment import BASE, Experiment, load
from fpt_ros.runs.run import Run, describe

YES, ONLY_IF, NO = "yes", "only if", "no"
STATUSES = (YES, ONLY_IF, NO)
"""Whether a claim reproduces: as it is printed, under a condition that is not, or not at all."""

Result = TypeVar("Result")

Runs = Mapping[str, Run]
"""The runs of a claim, by the keys under which it asks for them."""

Drawn = tuple[Figure, Sequence[str]]
"""A figure, and what its caption has to say besides."""


class Source(Protocol[Result]):
    """Something that a claim is judged by, and how to get it."""

    @property
    def effort(self) -> float:
        """A rough measure of how long it takes."""

    def perform(self, key: str) -> Result:
        """Make it; ``key`` is what figures call it."""

    def ending(self, result: Result) -> str:
        """Why it did not come to its end; empty: it did."""

    def command(self) -> str:
        """The line for a shell that makes the same."""


HEAVY = {"cart_beam_hamper": 6.0, "swing": 8.0, "kapitza": 3.0, "spherical_pendulum": 3.0}
"""Experiments that take longer than a short one, and how many times."""


@dataclass(frozen=True)
class Setup:
    """A run that a claim needs: what ``fpt simulate`` is given."""

    name: str
    variant: str = BASE
    settings: tuple[str, ...] = ()
    duration: float | None = None

    def experiment(self) -> Experiment:
        """Its parameters, complete and checked."""
        return load(self.name, self.variant, self.settings, self.duration)

    @property
    def effort(self) -> float:
        """1 for a short run."""
        return HEAVY.get(self.name, 1.0)

    def perform(self, key: str) -> Run:
        """The run, in process; one that diverges ends where it does."""
        from fpt_ros.engine.engine import Engine

        experiment = self.experiment()
        engine = Engine(experiment.loop())
        reason = ""
        try:
            engine.run()
        except RunFailed as error:
            reason = str(error)
        info = {**describe(experiment, "in_process", reason), "variant": key}
        return Run(info, experiment.nodes, engine.topics())

    def ending(self, result: Run) -> str:
        """Why the run did not come to its end."""
        return str(result.info["reason"])

    def command(self) -> str:
        """The line for a shell that makes this run."""
        words = ["fpt", "simulate", self.name]
        if self.variant != BASE:
            words += ["--variant", self.variant]
        for setting in self.settings:
            words += ["--set", setting]
        if self.duration is not None:
            words += ["--duration", f"{self.duration:g}"]
        return shlex.join(words)


@dataclass(frozen=True)
class Table:
    """Numbers of several runs or parameters side by side."""

    headings: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


@dataclass(frozen=True)
class Verdict:
    """What became of a claim.

    Attributes:
        status: of :data:`STATUSES`.
        measured: what was measured, in words with the unit -> the number, or a word.
        reason: why the status is what it is, in a sentence or two; of "only if" the condition.
        table: more numbers.
    """

    status: str
    measured: Mapping[str, float | str | None]
    reason: str
    table: Table | None = None


@dataclass(frozen=True)
class Picture(Generic[Result]):
    """A figure of a claim.

    Attributes:
        thesis: the thesis's figures that it redraws (``2.3, 2.4``); empty: it has none like it.
        title, caption: what it shows, what there is to see.
        draw: makes it; ``None`` where the results have nothing for it.
    """

    thesis: str
    title: str
    draw: Callable[[Mapping[str, Result]], Drawn | None]
    caption: str = ""


@dataclass(frozen=True)
class Claim(Generic[Result]):
    """One sentence of the thesis that can be true or not.

    Attributes:
        section: where it stands.
        figures: the thesis's figures that are to show it (``2.1-2.4``).
        text: the claim.
        runs: what is needed to judge it, by key; the keys head the columns of the pictures.
        judge: pure, of the runs by key; one that diverged is there, up to where it did.
        pictures: from the same results.
    """

    section: str
    figures: str
    text: str
    runs: Mapping[str, Source[Result]]
    judge: Callable[[Mapping[str, Result]], Verdict]
    pictures: tuple[Picture[Result], ...] = field(default=(), repr=False)

    def perform(self) -> dict[str, Result]:
        """All that it needs, by key."""
        return {key: source.perform(key) for key, source in self.runs.items()}


@dataclass(frozen=True)
class Chapter:
    """A chapter of the thesis; ``claims`` by identifier, its section and a letter (``2.2.1a``)."""

    number: int
    title: str
    claims: Mapping[str, Claim[Any]]


@cache
def chapters() -> Mapping[int, Chapter]:
    """All chapters that have claims, by number."""
    found = {}
    for module in iter_modules(thesis.__path__):
        match = re.fullmatch(r"chapter(\d+)", module.name)
        if match:
            number = int(match[1])
            contents = import_module(f"{thesis.__name__}.{module.name}")
            found[number] = Chapter(number, contents.TITLE, _named(contents.CLAIMS))
    return dict(sorted(found.items()))


def _named(claims: Sequence[Claim[Any]]) -> Mapping[str, Claim[Any]]:
    named: dict[str, Claim[Any]] = {}
    for claim in claims:
        count = sum(one.section == claim.section for one in named.values())
        named[claim.section + chr(ord("a") + count)] = claim
    return named


def numbers(figures: str) -> list[str]:
    """The single figures of a text: ``2.1-2.3, 3.4`` are 2.1, 2.2, 2.3 and 3.4."""
    found = []
    for part in filter(None, figures.split(", ")):
        first, _, last = part.partition("-")
        chapter, _, start = first.partition(".")
        end = last.partition(".")[2] or start
        found += [f"{chapter}.{i}" for i in range(int(start), int(end) + 1)]
    return found
