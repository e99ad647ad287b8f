"""The thesis's claims about its experiments, each with what decides whether it reproduces.

A chapter is a list of groups: runs that belong together, the claims about them, and the figures
that show them. A claim is judged from the numbers of the runs alone.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from fpt_ros.loop.run import Run

YES, ONLY_IF, NO = "yes", "only if", "no"
"""Does a claim reproduce?"""


@dataclass(frozen=True)
class Case:
    """One run.

    Attributes:
        name, variant: of the experiment.
        settings: ``NODE.PARAM=VALUE`` each.
        duration: [s]; ``None``: the experiment's own.
    """

    name: str
    variant: str = "adaptive"
    settings: tuple[str, ...] = ()
    duration: float | None = None

    @property
    def command(self) -> str:
        """The command that repeats it."""
        parts = ["fpt simulate", self.name]
        if self.variant != "adaptive":
            parts.append(f"--variant {self.variant}")
        parts += [f"--set {setting}" for setting in self.settings]
        if self.duration is not None:
            parts.append(f"--duration {self.duration:g}")
        return " ".join(parts)


@dataclass(frozen=True)
class Outcome:
    """What a run was worth.

    Attributes:
        rms: settled rms tracking error by coordinate; ``None`` where the run was lost before.
        chatter: mean step of the deformed response.
        tuning: name -> (first, last, least, largest) of what was tuned.
        lost: time at which the loop was lost [s], or ``None``.
        probes: numbers that the group's own probe took.
    """

    rms: Mapping[str, float | None]
    chatter: float | None
    tuning: Mapping[str, tuple[float, float, float, float]]
    lost: float | None
    probes: Mapping[str, float]

    def error(self, coordinate: str = "") -> float:
        """Settled rms of a coordinate, or the largest of all; infinite where the run was lost."""
        values = [self.rms[coordinate]] if coordinate else list(self.rms.values())
        known = [value for value in values if value is not None]
        lost = self.lost is not None or len(known) < len(values) or not known
        return float("inf") if lost else max(known)


@dataclass(frozen=True)
class Verdict:
    """Whether a claim reproduces: ``yes``, ``only if`` or ``no``; what was measured; why."""

    status: str
    measured: str
    reason: str = ""


Outcomes = Mapping[str, Outcome]
"""By the key of the case in its group."""

Judge = Callable[[Outcomes], Verdict]


@dataclass(frozen=True)
class Claim:
    """One claim of the thesis: section, figures, the claim in a sentence, and its judge.

    ``cases`` are keys of the group's cases that decide it.
    """

    section: str
    figures: str
    text: str
    cases: tuple[str, ...]
    judge: Judge


@dataclass(frozen=True)
class Pictures:
    """Figures of some cases side by side: names of :mod:`fpt_ros.analysis.figures`."""

    cases: tuple[str, ...]
    charts: tuple[str, ...]


@dataclass(frozen=True)
class Group:
    """Runs that belong together.

    ``probe`` takes further numbers from each run; it is a function of a module, because the runs
    are made in other processes.
    """

    title: str
    cases: Mapping[str, Case]
    claims: tuple[Claim, ...]
    pictures: tuple[Pictures, ...]
    probe: Callable[[Run], Mapping[str, float]] | None = None


def times(a: float, b: float) -> str:
    """How many times smaller a is than b, in words."""
    return f"{b / a:.3g} times" if a > 0.0 and b < float("inf") else "out of all proportion"


def holds(condition: bool, measured: str, reason: str = "", otherwise: str = NO) -> Verdict:
    """``yes`` where the condition holds."""
    return Verdict(YES if condition else otherwise, measured, reason)
