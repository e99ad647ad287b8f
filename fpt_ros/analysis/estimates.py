"""Estimates of the signals of a table: in the order of time, and back in the order of the rows."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from fpt_ros.analysis.signal_source import Source
from fpt_ros.denoising.offline import DENOISERS, Mask, Result, denoise
from fpt_ros.errors import BadInput
from fpt_ros.parameters import Value
from fpt_ros.runs.run import Array
from fpt_ros.tables.table import Column, Kind, distinct, titled
from fpt_ros.tables.time_axis import REMEDY

RATES = {1: "rate", 2: "second rate"}
"""Names of the columns of derivatives."""

Progress = Callable[[int], None]
"""Is told how many samples are done."""


@dataclass(frozen=True)
class Estimate:
    """One signal and what was found, all (n,) in the order of the rows.

    Attributes:
        signal: its column.
        measured: its values, NaN where one is missing.
        estimate: of the clean signal.
        healed: where the sample was missing.
        result: what the method found, in the order of time, holes filled.
        order: of the derivative that was asked for; 0: none.
        derivative: of the estimate by time.
    """

    signal: Column
    measured: Array
    estimate: Array
    healed: Mask
    result: Result
    order: int = 0
    derivative: Array | None = None

    @property
    def residual(self) -> Array:
        """What was taken away, NaN where the sample was missing."""
        return self.measured - self.estimate


def estimate(
    source: Source,
    signal: Column,
    method: str,
    options: Mapping[str, Value],
    progress: Progress | None = None,
    derivative: int = 0,
) -> Estimate:
    """Denoise one signal of a source.

    Raises:
        BadInput: the signal cannot be denoised by this method, or its times cannot be used.
    """
    measured = signal.numbers()
    infinite = np.flatnonzero(np.isinf(measured))
    if len(infinite):
        raise BadInput(
            f"{source.table.name}: {signal.name} is infinite in "
            f"{source.table.where(int(infinite[0]))}: leave missing samples empty"
        )
    samples = source.spacing.samples(measured)
    result = _denoise(source, samples, method, options, progress, derivative)
    rows = source.spacing.rows(result.estimate)
    rate = None if result.derivative is None else source.spacing.rows(result.derivative)
    return Estimate(signal, measured, rows, np.isnan(measured), result, derivative, rate)


def _denoise(
    source: Source,
    samples: Array,
    method: str,
    options: Mapping[str, Value],
    progress: Progress | None,
    derivative: int,
) -> Result:
    """The one call of the method."""
    spacing = source.spacing
    if spacing.times is not None and not spacing.even and DENOISERS[method].whole is None:
        raise BadInput(
            f"{source.table.name}: {spacing.remarks[-1]}: {method} needs equal spacing, auto does "
            f"not; {REMEDY}"
        )
    uneven = spacing.times is not None and DENOISERS[method].whole is not None
    return denoise(
        samples,
        method,
        t=spacing.times if uneven else None,
        dt=spacing.step if source.axis is not None else 1.0,
        derivative=derivative,
        report=None if progress is None else lambda done, _: progress(done),
        **options,
    )


def remarks(source: Source) -> list[str]:
    """What a user should know about how the table and its times were taken."""
    return [*source.table.remarks, *source.spacing.remarks]


def columns_with(source: Source, found: list[Estimate]) -> list[Column]:
    """All columns of the table, behind them those that were found: healed, estimate."""
    new: list[Column] = []
    for one in found:
        unit = one.signal.unit
        front = f"{one.signal.name} " if len(found) > 1 else ""
        new.append(Column(f"{front}healed", Kind.NUMBER, one.healed.astype(np.int64)))
        new.append(Column(f"{front}estimate", Kind.NUMBER, one.estimate, unit))
        if one.derivative is not None:
            per = _per(source, unit, one.order)
            new.append(Column(f"{front}{RATES[one.order]}", Kind.NUMBER, one.derivative, per))
    titles = [each.title for each in (*source.table.columns, *new)]
    named = distinct(titles)[len(source.table.columns) :]
    return [
        *source.table.columns,
        *(
            Column(each.name, each.kind, each.values, each.unit, title)
            for each, title in zip(new, named, strict=True)
        ),
    ]


def _per(source: Source, unit: str, order: int) -> str:
    """Unit of a derivative by time."""
    time = source.axis.unit if source.axis is not None else ""
    if not time:
        return ""
    return f"{unit or '1'}/{time}" + ("\u00b2" if order == 2 else "")


def step_of(source: Source) -> tuple[float, str]:
    """The step between samples and its unit; 1 sample where there are no times."""
    if source.axis is None:
        return 1.0, ""
    second = source.axis.second
    if second is not None:
        return source.spacing.step * second, "s"
    return source.spacing.step, source.axis.unit


def name_of(one: Estimate) -> str:
    """The signal's name with its unit."""
    return titled(one.signal.name, one.signal.unit)
