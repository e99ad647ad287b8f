"""What the figures show of a loop: curves of the last seconds, thinned."""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fpt_ros.cycle.tuned import FACTOR, PRECURSOR
from fpt_ros.messages.frames import SECOND
from fpt_ros.runs.run import Array
from fpt_ros.tuning import GAIN
from fpt_ros.watch.heard import Heard
from fpt_ros.watch.thin import thin

BINS = 250
"""Stretches of the time that is shown."""

FIGURES = ("motion", "error", "response", "effort", "gain", "precursor", "tuned")


class Curves(NamedTuple):
    """Curves that have their times in common: (m,) [s], and by label (m,)."""

    x: Array
    y: dict[str, Array]


NONE = Curves(np.empty(0), {})


class Wanted(NamedTuple):
    """What to show: coordinates, seconds, and the gain where nobody tunes it.

    ``gains``: from which stamp [ns] on it was what; NaN: there is none.
    """

    joints: Sequence[str]
    seconds: float
    gains: Sequence[tuple[int, float]]


def joints_of(heard: Heard) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """All coordinates of a loop, and those that are controlled."""
    tracks = heard.tracks
    controlled = tracks["desired"].names
    return tuple(dict.fromkeys((*tracks["command"].names, *controlled))), controlled


def curves(heard: Heard, wanted: Wanted) -> dict[str, tuple[Curves, ...]]:
    """The curves of each of :data:`FIGURES`."""
    look = _Look(heard, wanted)
    motion = measured(heard)
    return {
        "motion": (
            look.vectors("desired", "positions", "{} nominal"),
            look.vectors(*motion, "{}"),
        ),
        "error": (look.differences(("desired", "positions"), motion),),
        "response": (
            look.vectors("desired", "accelerations", "{} desired"),
            look.vectors("command", "accelerations", "{} deformed"),
            look.vectors("state_estimate", "accelerations", "{} observed"),
        ),
        "effort": (look.vectors("command", "effort", "{}"),),
        **look.tuning(),
    }


def measured(heard: Heard) -> tuple[str, str]:
    """Topic and vector of the motion: of the plant, or as it is estimated of a robot."""
    if len(heard.tracks["joint_states"].ring.stamps):
        return "joint_states", "position"
    return "state_estimate", "positions"


class _Look:
    def __init__(self, heard: Heard, wanted: Wanted) -> None:
        self._heard, self._wanted = heard, wanted
        self._since = heard.last - round(wanted.seconds * SECOND)

    def vectors(self, topic: str, vector: str, label: str) -> Curves:
        """One vector of a topic, a curve a coordinate."""
        track = self._heard.tracks[topic]
        names = [name for name in self._wanted.joints if name in track.names]
        return self._thin(
            track.ring.stamps,
            track.ring.first,
            {label.format(name): track.column(vector, name) for name in names},
        )

    def differences(self, minuend: tuple[str, str], subtrahend: tuple[str, str]) -> Curves:
        """One vector minus another, at the stamps that both have."""
        a, b = self._heard.tracks[minuend[0]], self._heard.tracks[subtrahend[0]]
        names = [name for name in self._wanted.joints if name in a.names and name in b.names]
        first, second = a.ring.stamps, b.ring.stamps
        i = int(np.searchsorted(first, self._since))
        at = np.searchsorted(second, first[i:])
        both = at < len(second)
        both[both] = second[at[both]] == first[i:][both]
        found = {
            name: (a.column(minuend[1], name)[i:][both] - b.column(subtrahend[1], name)[at[both]])
            for name in names
        }
        return self._thin(first[i:][both], a.ring.first + i, found)

    def tuning(self) -> Mapping[str, tuple[Curves, ...]]:
        """The gain that acts, the precursor, and what else is tuned."""
        track = self._heard.tracks["tuning"]
        signals = (GAIN, FACTOR, PRECURSOR)
        values = {name: track.column("values", name) for name in track.names}
        stamps, first = track.ring.stamps, track.ring.first
        if not len(stamps):
            track = self._heard.tracks["command"]
            stamps, first = track.ring.stamps, track.ring.first
        gain = values[GAIN] if GAIN in values else self._untuned(stamps)
        acting = gain * values.get(FACTOR, np.ones(len(stamps)))
        known = {name: values[name] for name in (PRECURSOR, FACTOR) if name in values}
        others = {name: each for name, each in values.items() if name not in signals}
        gains = {GAIN: acting} if np.isfinite(acting).any() else {}
        return {
            "gain": (self._thin(stamps, first, gains),),
            "precursor": (self._thin(stamps, first, known),),
            "tuned": (self._thin(stamps, first, others),),
        }

    def _untuned(self, stamps: NDArray[np.int64]) -> Array:
        """The parameter A as it was at each stamp."""
        since = np.array([stamp for stamp, _ in self._wanted.gains], dtype=np.int64)
        gains = np.array([np.nan, *[gain for _, gain in self._wanted.gains]])
        return gains[np.searchsorted(since, stamps, side="right")]

    def _thin(self, stamps: NDArray[np.int64], first: int, columns: dict[str, Array]) -> Curves:
        start = int(np.searchsorted(stamps, self._since))
        if not columns or start == len(stamps):
            return NONE
        rows = np.stack([each[start:] for each in columns.values()], axis=1)
        rows = np.where(np.isfinite(rows), rows, np.nan)
        x, thinned = thin(self._heard.seconds(stamps[start:]), rows, BINS, first + start)
        return Curves(x, dict(zip(columns, thinned.T, strict=True)))
