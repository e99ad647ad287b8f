"""A sentence of the thesis that can be true or not, and what becomes of it.

A claim names what it needs, runs of experiments (:class:`~fpt_ros.thesis.setup.Setup`) or trials of
denoisers (:class:`~fpt_ros.thesis.trials.Trial`); a pure function judges them, and its pictures
draw them.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Generic, Protocol, TypeVar

from matplotlib.figure import Figure

YES, ONLY_IF, NO = "yes", "only if", "no"
STATUSES = (YES, ONLY_IF, NO)
"""Whether a claim reproduces: as it is printed, under a condition that is not, or not at all."""

Result = TypeVar("Result")
Drawn = tuple[Figure, Sequence[str]]
"""A figure, and what its caption has to say besides."""


class Evidence(Protocol[Result]):
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
    runs: Mapping[str, Evidence[Result]]
    judge: Callable[[Mapping[str, Result]], Verdict]
    pictures: tuple[Picture[Result], ...] = field(default=(), repr=False)

    def perform(self) -> dict[str, Result]:
        """All that it needs, by key."""
        return {key: source.perform(key) for key, source in self.runs.items()}
