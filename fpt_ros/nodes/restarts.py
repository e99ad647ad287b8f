"""How often a node may be started again."""

from collections import defaultdict

MINUTE = 60.0

DEFAULT = 3
"""Restarts of a node in a minute: what fails more often does so for a reason of its own."""


class Restarts:
    """Counts the restarts of each node.

    Attributes:
        total: of all nodes.
    """

    def __init__(self, most: int = DEFAULT) -> None:
        """``most`` of one node in a minute."""
        self.total = 0
        self._most = most
        self._times: dict[str, list[float]] = defaultdict(list)

    def allow(self, name: str, now: float) -> bool:
        """Whether a node may be started again at ``now`` [s]; if so, it counts."""
        recent = [time for time in self._times[name] if now - time < MINUTE]
        if len(recent) >= self._most:
            return False
        self._times[name] = [*recent, now]
        self.total += 1
        return True
