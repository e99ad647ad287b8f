"""What was tuned in a run, and how much of it was learned."""

from collections.abc import Mapping

from fpt_ros.analysis import signals
from fpt_ros.runs.run import Array, Run
from fpt_ros.thesis.claim import Table
from fpt_ros.thesis.measures import rms


def tuned(run: Run, name: str) -> tuple[Array, Array]:
    """Times [s] and values of something that is tuned."""
    return signals.topic(run, "tuning", "values", name)


def last(run: Run, name: str) -> float:
    """Final value of something that is tuned."""
    return float(tuned(run, name)[1][-1])


def window(run: Run, name: str, start: float, end: float) -> float:
    """Rms of something that is tuned between two times [s]."""
    time, values = tuned(run, name)
    return rms(values[(time >= start) & (time < end)])


def coefficients(run: Run) -> dict[str, tuple[float, float, float]]:
    """Tuned coefficients of the model: start, end and exact value."""
    series = run.topics["tuning"]
    return {
        name: (float(series.column("values", name)[0]), last(run, name), exact)
        for name, exact in signals.exact_coefficients(run).items()
        if name in series.names
    }


def learned(start: float, end: float, exact: float) -> float:
    """How much of a parameter's error is gone: 1 all of it, 0 nothing, negative: it grew."""
    return 1.0 - abs(end - exact) / abs(start - exact) if start != exact else 0.0


def coefficient_table(runs: Mapping[str, Run]) -> Table:
    """Start, exact value, and where each run ends, of the coefficients."""
    found = {key: coefficients(run) for key, run in runs.items()}
    first = next(iter(found.values()))
    rows = [
        (
            name,
            f"{start:.4g}",
            f"{exact:.4g}",
            *(f"{each[name][1]:.4g} ({learned(*each[name]):.0%})" for each in found.values()),
        )
        for name, (start, _, exact) in first.items()
    ]
    ends = [f"end, {key}" if len(runs) > 1 else "end" for key in found]
    return Table(("parameter", "start", "exact", *ends), tuple(rows))
