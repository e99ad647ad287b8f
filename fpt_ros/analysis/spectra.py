"""Spectra of positions before and after the denoiser, taken chunk by chunk (Welch, 1967)."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from fpt_ros.analysis import signals
from fpt_ros.parameters import Values
from fpt_ros.runs.chunks import Chunk
from fpt_ros.runs.run import Array, Run

SEGMENT = 4096
"""Samples of a segment; each begins in the middle of the one before."""


@dataclass(frozen=True)
class Spectrum:
    """Amplitude densities of one position.

    Attributes:
        frequency: (M,) [Hz], without 0.
        before, after: (M,) measured, and as estimated [unit/sqrt(Hz)].
    """

    frequency: Array
    before: Array
    after: Array


class Spectra:
    """Takes a run chunk by chunk; keeps a sum of squared spectra of each position.

    Args:
        parameters: of every node; nothing is kept of a run that has no denoiser.
    """

    def __init__(self, parameters: Mapping[str, Values]) -> None:
        about = Run({}, parameters, {})
        self._dt = signals.parameter_number(about, "plant_simulator", "dt")
        self._denoised = signals.parameter(about, "denoiser", "method") not in (None, "none")
        self._before: dict[str, _Welch] = {}
        self._after: dict[str, _Welch] = {}

    def take(self, chunk: Chunk) -> None:
        """Take the next cycles."""
        if not self._denoised:
            return
        for topic, vector, kept in (
            ("joint_states", "position", self._before),
            ("state_estimate", "positions", self._after),
        ):
            series = chunk.get(topic)
            for name in series.names if series is not None else ():
                assert series is not None
                kept.setdefault(name, _Welch()).add(series.column(vector, name))

    def result(self) -> dict[str, Spectrum]:
        """By name of the coordinate, of those that have both."""
        found = {}
        for name, before in self._before.items():
            after = self._after.get(name)
            if after is None or self._dt is None:
                continue
            both = before.density(self._dt), after.density(self._dt)
            if len(both[0]) == len(both[1]) and len(both[0]):
                count = len(both[0])
                frequency = np.arange(1, count + 1) / (2 * count * self._dt)
                found[name] = Spectrum(frequency, *both)
        return found


class _Welch:
    """Mean squared spectrum of segments that overlap by half, under a Hann window."""

    def __init__(self) -> None:
        self._held = np.empty(0)
        self._sum = np.zeros(SEGMENT // 2 + 1)
        self._count = 0

    def add(self, values: Array) -> None:
        """Add the samples that follow."""
        held = np.concatenate((self._held, values))
        first = 0
        while first + SEGMENT <= len(held):
            squares = _squares(held[first : first + SEGMENT])
            if np.isfinite(squares).all():  # a segment with a gap says nothing
                self._sum += squares
                self._count += 1
            first += SEGMENT // 2
        self._held = held[first:].copy()

    def density(self, dt: float) -> Array:
        """(M,) amplitude density without the frequency 0; empty where there is none."""
        squares, count, length = self._sum, self._count, SEGMENT
        if not count:  # a short run is one segment
            length = len(self._held) // 2 * 2
            squares, count = _squares(self._held[:length]), 1
        if length < 4 or not np.isfinite(squares).all():
            return np.empty(0)
        power = 2.0 * squares[1:] / count * dt / np.square(_window(length)).sum()
        power[-1] /= 2.0  # half the sampling rate has no counterpart at negative frequencies
        return np.asarray(np.sqrt(power))


def _window(length: int) -> Array:
    turns = np.arange(length) / max(length, 1)
    return np.asarray(0.5 - 0.5 * np.cos(2.0 * np.pi * turns))


def _squares(segment: Array) -> Array:
    if not len(segment):
        return np.empty(0)
    return np.asarray(np.abs(np.fft.rfft(_window(len(segment)) * (segment - segment.mean()))) ** 2)
