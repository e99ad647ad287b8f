"""Colours and legends of the curves of runs."""

from collections.abc import Sequence

from matplotlib.lines import Line2D

from fpt_ros.analysis import signals, style
from fpt_ros.runs.run import Run

Entry = Line2D | tuple[Line2D, ...]
"""Of a legend: one line, or several beside each other."""


def colour_of(run: Run, name: str) -> str:
    """The colour of a coordinate, the same in all figures of a run."""
    states = run.topics.get("joint_states")
    return style.colour(states.names if states is not None else (), name)


def realised(runs: Sequence[Run], rows: Sequence[str]) -> Entry:
    """Legend entry of the realised curves, in the colours that they have."""
    colours = dict.fromkeys(
        colour_of(run, name) for name in rows for run in runs if name in signals.controlled(run)
    )
    return tuple(style.handle("realised", style.thin(colour)) for colour in colours)


def followed(runs: Sequence[Run], rows: Sequence[str]) -> tuple[Entry, Entry]:
    """Legend of the nominal band and the lines that follow it."""
    return style.handle("nominal", style.BAND), realised(runs, rows)
