"""The interval of the gain A in which the iteration contracts: its one definition.

A small response error is multiplied by 1 + A slope lambda (1 + feedback) (:mod:`.contraction`), so
that |A| has to be below 2 scale / |slope|. The scale follows from plant, model and motion; the
slope from the transformation alone, which is all that a node needs to judge a gain in flight.
"""

Interval = tuple[float, float]


def linear_limit(slope: float, scale: float) -> float:
    """The |A| up to which small response errors decay; ``scale``: |A| of the map with p = 1."""
    return 2.0 / abs(slope) * scale


def sign_of(slope: float, side: float) -> int:
    """The sign of an A that contracts; ``side``: that of the response's eigenvalues."""
    return -1 if slope * side >= 0.0 else 1


def interval(sign: int, limit: float) -> Interval:
    """The open interval of A; empty where the limit is 0."""
    return (-limit, 0.0) if sign < 0 else (0.0, limit)


def holds(A: float, within: Interval) -> bool:
    """Whether small response errors decay with this gain."""
    low, high = within
    return low < A < high
