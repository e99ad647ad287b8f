"""What the processes of a graph take of the machine: what each says of itself, and all of it.

Every node tells it once a second on /diagnostics; a recording holds that, and ``fpt info`` and the
report show it. The keys are defined here alone.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

PROCESS = "process"
PROCESSOR = "processor [%]"
MEMORY = "memory [MB]"
"""Keys of each node on /diagnostics: whose figures they are, as ``PID@HOST`` (nodes of one process
share them), part of one core since the report before, and the memory that is resident."""


@dataclass(frozen=True)
class Report:
    """What one node says once.

    Attributes:
        node: its name, without the namespace.
        process: in which it runs; of nodes that do not tell, the node itself.
        processor: [% of one core] since the report before.
        memory: resident [MB].
    """

    node: str
    process: str
    processor: float
    memory: float


@dataclass(frozen=True)
class Cost:
    """What one process took over a run.

    Of one that was started again the processor counts from the start of the run, the memory from
    its own.

    Attributes:
        nodes: that it ran, by name.
        reports: how often that was told.
        mean, largest: processor [% of one core], of the reports.
        first, last: resident memory [MB] in the first and the last report.
    """

    nodes: tuple[str, ...]
    reports: int
    mean: float
    largest: float
    first: float
    last: float

    @property
    def growth(self) -> float:
        """Of the memory [MB]."""
        return self.last - self.first

    def numbers(self) -> dict[str, object]:
        """As JSON has them, units in the names."""
        return {
            "nodes": list(self.nodes),
            "reports": self.reports,
            "processor_mean_percent": round(self.mean, 2),
            "processor_max_percent": self.largest,
            "memory_start_mb": self.first,
            "memory_end_mb": self.last,
            "memory_growth_mb": round(self.growth, 1),
        }


HEADINGS = ("node", "processor [%]", "largest", "memory [MB]", "at end", "growth")
"""Of the table of processes that ``fpt info`` and the report show; the first numbers are the mean,
and the memory at the start."""


def row(cost: Mapping[str, Any]) -> tuple[str, ...]:
    """Of that table; ``cost``: :meth:`Cost.numbers`."""
    return (
        ", ".join(cost["nodes"]),
        f"{cost['processor_mean_percent']:.1f}",
        f"{cost['processor_max_percent']:.1f}",
        f"{cost['memory_start_mb']:.1f}",
        f"{cost['memory_end_mb']:.1f}",
        f"{cost['memory_growth_mb']:+.1f}",
    )


class Costs:
    """Takes what nodes say, and keeps their numbers only."""

    def __init__(self) -> None:
        self._nodes: dict[str, tuple[str, Cost]] = {}

    def add(self, report: Report) -> None:
        """What one node says next."""
        share, memory = report.processor, report.memory
        fresh = Cost((report.node,), 0, 0.0, 0.0, memory, memory)
        process, cost = self._nodes.get(report.node, (report.process, fresh))
        count = cost.reports + 1
        cost = replace(
            cost,
            reports=count,
            mean=cost.mean + (share - cost.mean) / count,
            largest=max(cost.largest, share),
            first=cost.first if process == report.process else memory,
            last=memory,
        )
        self._nodes[report.node] = report.process, cost

    def result(self) -> tuple[Cost, ...]:
        """Of every process; nodes that share one say the same, and the first of them counts."""
        shared: dict[str, list[Cost]] = {}
        for _, (process, cost) in sorted(self._nodes.items()):
            shared.setdefault(process, []).append(cost)
        return tuple(
            replace(same[0], nodes=tuple(name for each in same for name in each.nodes))
            for same in shared.values()
        )
