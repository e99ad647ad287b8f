"""What the filters of the loop would have said in flight: which is best, and how late."""

from collections.abc import Mapping

import numpy as np

from fpt_ros.analysis.compared_methods import Row
from fpt_ros.analysis.estimates import Estimate, step_of
from fpt_ros.analysis.signal_source import Source
from fpt_ros.denoising.offline import Result, denoise
from fpt_ros.denoising.offline.noise import noise_sigma
from fpt_ros.denoising.streaming import FILTERS
from fpt_ros.engine.over_record import Filtered, over_record
from fpt_ros.errors import BadInput
from fpt_ros.parameters import Value
from fpt_ros.runs.run import Array
from fpt_ros.tables.table import Column

ERRORS = ("value", "velocity", "acceleration")
SETTLING = 0.1
"""Share of the record that is not judged: filters begin at rest."""
NOT_COMPARED = ("none", "fitzhugh_nagumo_observer")
"""The one wants a measured velocity, the other is of one plant."""


def _samples(source: Source, signal: Column) -> Array:
    """The signal in the order of time, from its first sample on that is there."""
    if source.spacing.times is not None and not source.spacing.even:
        raise BadInput(
            f"{source.table.name}: filters of the loop need equal steps of time, which differ "
            "here: --method auto takes them, or resample"
        )
    samples = source.spacing.samples(signal.numbers())
    if len(samples) < 4 or not np.isfinite(samples).any():
        raise BadInput(f"{source.table.name}: {signal.name} has too few samples to be filtered")
    return samples


def _run(name: str, y: Array, dt: float, options: Mapping[str, Value]) -> Filtered:
    """The filter from the first finite sample on; before it, and at it, the estimate is NaN."""
    first = int(np.flatnonzero(np.isfinite(y))[0])
    if len(y) - first < 4:
        raise BadInput(f"{name} needs at least 4 samples")
    found = over_record(name, y[first:], dt, **options)

    def behind(x: Array) -> Array:
        return np.concatenate((np.full(first, np.nan), x))

    return Filtered(
        behind(found.value), behind(found.velocity), behind(found.acceleration), found.delay
    )


def filtered(
    source: Source,
    signal: Column,
    name: str,
    options: Mapping[str, Value],
    derivative: int = 0,
) -> Estimate:
    """A signal through the registered filter ``name``, sample by sample.

    Raises:
        BadInput: no such filter, an option that is not valid, or unequal steps of time.
    """
    if derivative not in (0, 1, 2):
        raise BadInput(f"--derivative {derivative}: it takes 1 or 2")
    y = _samples(source, signal)
    step, unit = step_of(source)
    found = _run(name, y, step, options)
    present = np.isfinite(y)
    value = np.where(np.isnan(found.value) & present, y, found.value)
    result = Result(
        value, ~present, name, noise_sigma(np.where(present, y, value), present),
        {**{k: v for k, v in options.items() if isinstance(v, bool | int | float | str)},
         "delay": f"{found.delay:.4g} {unit or 'samples'}"},
    )  # fmt: skip
    rows = source.spacing.rows
    rate = (None, found.velocity, found.acceleration)[derivative]
    measured = signal.numbers()
    return Estimate(
        signal, measured, rows(value), np.isnan(measured), result, derivative,
        None if rate is None else rows(rate),
    )  # fmt: skip


def _reference(source: Source, y: Array, dt: float) -> tuple[Array, Array, Array]:
    """Value, velocity and acceleration to judge by: the clean signal's, else those of ``auto``."""
    clean = source.clean
    if clean is not None:
        velocity = np.gradient(clean, dt)
        return clean, velocity, np.gradient(velocity, dt)
    found = denoise(y, dt=dt, derivative=1)
    second = denoise(y, dt=dt, derivative=2)
    assert found.derivative is not None
    assert second.derivative is not None
    return found.estimate, found.derivative, second.derivative


def compare_filters(source: Source, signal: Column) -> list[Row]:
    """A row a filter at its defaults, the best first.

    Keys: the rms errors against the clean signal or, where that is not known, against what ``auto``
    makes of the whole record; ``score``, the geometric mean of their ratios to the least of each;
    ``delay`` [s]. A filter that cannot be run has the key ``error``.
    """
    y = _samples(source, signal)
    dt, _ = step_of(source)
    reference = _reference(source, y, dt)
    late = slice(max(int(SETTLING * len(y)), 2), None)
    rows: list[Row] = []
    refused: list[Row] = []
    for name in FILTERS.names():
        if name in NOT_COMPARED:
            continue
        try:
            found = _run(name, y, dt, {})
        except BadInput as error:
            refused.append({"method": name, "error": str(error)})
            continue
        estimates = (found.value, found.velocity, found.acceleration)
        errors = [
            float(np.sqrt(np.nanmean((x[late] - truth[late]) ** 2)))
            for x, truth in zip(estimates, reference, strict=True)
        ]
        own = dict(zip(ERRORS, errors, strict=True))
        rows.append({"method": name, **own, "delay": found.delay})
    for row in rows:
        ratios = [
            max(float(row[key]), 1e-300) / max(min(float(one[key]) for one in rows), 1e-300)
            for key in ERRORS
        ]
        row["score"] = float(np.prod(ratios) ** (1.0 / len(ratios)))
    return [*sorted(rows, key=lambda row: row["score"]), *refused]
