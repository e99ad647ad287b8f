"""Estimates of the signals of a table: in the order of time, and back in the order of the rows."""

import inspect
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from fpt_ros.analysis.signal_source import Source
from fpt_ros.denoising.offline import Mask, Result, denoise
from fpt_ros.errors import BadInput
from fpt_ros.parameters import Value
from fpt_ros.runs.run import Array
from fpt_ros.tables.table import Column, Kind, distinct, titled
from fpt_ros.tables.time_axis import REMEDY

Progress = Callable[..., None]
"""Is told how far a method is; :func:`~fpt_ros.denoising.offline.denoise` says in which terms."""


@dataclass(frozen=True)
class Estimate:
    """One signal and what was found, all (n,) in the order of the rows.

    Attributes:
        signal: its column.
        measured: its values, NaN where one is missing.
        estimate: of the clean signal.
        healed: where the sample was missing.
        result: what the method found, in the order of time, holes filled.
    """

    signal: Column
    measured: Array
    estimate: Array
    healed: Mask
    result: Result

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
    result = _denoise(source, source.spacing.samples(measured), method, options, progress)
    rows = source.spacing.rows(result.estimate)
    return Estimate(signal, measured, rows, np.isnan(measured), result)


def _denoise(
    source: Source,
    samples: Array,
    method: str,
    options: Mapping[str, Value],
    progress: Progress | None,
) -> Result:
    """The one call of the method.

    ``t``, ``progress`` (and ``derivative``) are given where ``denoise`` has them. This is the place
    for ``--derivative`` and ``--streaming`` (a filter run over the record gives a Result too).
    """
    spacing, known = source.spacing, inspect.signature(denoise).parameters
    extra: dict[str, object] = {}
    if progress is not None and "progress" in known:
        extra["progress"] = progress
    if spacing.times is not None and "t" in known:
        extra["t"] = spacing.times
    elif not spacing.even:
        raise BadInput(
            f"{source.table.name}: {spacing.remarks[-1]}: {method} needs equal spacing; "
            f"interpolate to it first, {REMEDY}"
        )
    return denoise(samples, method, **options, **extra)  # type: ignore[arg-type]


def remarks(source: Source) -> list[str]:
    """What a user should know about how the table and its times were taken."""
    found = [*source.table.remarks, *source.spacing.remarks]
    if source.spacing.times is not None and "t" not in inspect.signature(denoise).parameters:
        found.append("the rows are taken as equally spaced")
    return found


def columns_with(source: Source, found: list[Estimate]) -> list[Column]:
    """All columns of the table, behind them those that were found: healed, estimate."""
    new: list[Column] = []
    for one in found:
        unit = one.signal.unit
        front = f"{one.signal.name} " if len(found) > 1 else ""
        new.append(Column(f"{front}healed", Kind.NUMBER, one.healed.astype(np.int64)))
        new.append(Column(f"{front}estimate", Kind.NUMBER, one.estimate, unit))
    titles = [each.title for each in (*source.table.columns, *new)]
    named = distinct(titles)[len(source.table.columns) :]
    return [
        *source.table.columns,
        *(
            Column(each.name, each.kind, each.values, each.unit, title)
            for each, title in zip(new, named, strict=True)
        ),
    ]


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
