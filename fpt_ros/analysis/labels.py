"""What runs are called in headings, and the colours of their coordinates."""

from collections.abc import Callable, Sequence
from typing import TypeVar

from fpt_ros.analysis import style
from fpt_ros.runs.run import Run

R = TypeVar("R", bound=Run)


def labels_of(runs: Sequence[tuple[str, str]]) -> list[str]:
    """What tells runs (experiment, variant) from each other: as little as is needed."""
    several = len({experiment for experiment, _ in runs}) > 1 or len(runs) == 1
    labels = []
    for at, (experiment, variant) in enumerate(runs):
        text = f"{experiment} · {variant}" if several else variant
        if runs.count((experiment, variant)) > 1:
            text += f" ({runs[: at + 1].count((experiment, variant))})"
        labels.append(text)
    return labels


def run_labels(runs: Sequence[Run]) -> list[str]:
    """Headings of runs side by side."""
    return labels_of([(r.info.get("experiment", ""), r.info.get("variant", "")) for r in runs])


def all_names(runs: Sequence[R], names: Callable[[R], Sequence[str]]) -> list[str]:
    """The names of all runs, each once, in the order in which they are met."""
    return list(dict.fromkeys(name for run in runs for name in names(run)))


def colour_of(run: Run, name: str) -> str:
    """The colour of a coordinate, the same in all figures of a run."""
    states = run.topics.get("joint_states")
    return style.colour(states.names if states is not None else (), name)
