"""Names of what the iteration does with a gain, and the intervals of |A| in which it does so."""

from dataclasses import dataclass

RUNS_AWAY = "runs away"
MONOTONE = "monotone"
PRECURSOR = "precursor oscillation"
TWO_CYCLE = "two-cycle"
DOUBLING = "period doubling"
DOUBLING_TO_CHAOS = "period doubling, chaos"
CHAOS = "chaos"
LEAVES = "leaves the domain"
SPIRAL = "spirals into the solution"
CIRCLES = "circles around the solution"
OR_TWO_CYCLE = f" or {TWO_CYCLE}"


@dataclass(frozen=True)
class Band:
    """What the iteration does for |A| between two values; ``end``: inf where that is the last."""

    start: float
    end: float
    name: str


def verb(behaviour: str) -> str:
    """What an iteration of this behaviour does: "it ..."."""
    return {
        TWO_CYCLE: "chatters in a two-cycle",
        DOUBLING: "chatters, its period doubled",
        DOUBLING_TO_CHAOS: "chatters, periodically or in chaos",
        CHAOS: "is chaotic",
    }.get(behaviour, behaviour)
