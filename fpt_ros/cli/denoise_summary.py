"""What ``fpt denoise`` tells: how the file was read, what was found, and what is odd about it."""

import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rich.console import Console

    from fpt_ros.analysis.compared_methods import Row
    from fpt_ros.analysis.estimates import Estimate
    from fpt_ros.analysis.signal_source import Source
    from fpt_ros.denoising.offline import Result


def numbers(source: "Source", found: "Estimate") -> dict[str, Any]:
    """What was found of one signal: plain values, as JSON has them."""
    from fpt_ros.analysis.compared_methods import success

    return {
        "signal": found.signal.name,
        "unit": found.signal.unit,
        "method": found.result.method,
        "samples": len(found.measured),
        "healed": int(found.healed.sum()),
        "sigma": found.result.sigma,
        **success(source, found),
        "info": dict(found.result.info),
    }


def times(source: "Source") -> dict[str, Any] | None:
    """The times: column, unit, step, and whether they are equally spaced."""
    if source.axis is None:
        return None
    return {
        "column": source.axis.column,
        "unit": source.axis.unit,
        "first": float(source.axis.values.min()),
        "last": float(source.axis.values.max()),
        "step": source.spacing.step,
        "equally_spaced": source.spacing.times is None,
    }


def print_source(screen: "Console", source: "Source") -> None:
    """How the file was read and its times; remarks go to standard error."""
    if source.table.layout:
        say(screen, f"{source.table.name}: {source.table.layout}")
    axis, step = source.axis, source.spacing.step
    if axis is not None:
        unit = f" {axis.unit}" if axis.unit else ""
        first, last = float(axis.values.min()), float(axis.values.max())
        rate = f", {1.0 / (step * axis.second):.6g} Hz" if axis.second and step else ""
        say(
            screen,
            f"times: {axis.column}, {first:g} to {last:g}{unit}, step {step:.6g}{unit}{rate}",
        )
    from fpt_ros.analysis.estimates import remarks

    for remark in remarks(source):
        print(f"fpt: note: {remark}", file=sys.stderr)


def print_found(screen: "Console", source: "Source", found: "Estimate") -> None:
    """What was found of one signal."""
    from fpt_ros.analysis.compared_methods import success

    unit = f" {found.signal.unit}" if found.signal.unit else ""
    healed = f", {int(found.healed.sum())} of them healed" if found.healed.any() else ""
    samples = f"{len(found.measured)} samples{healed}"
    say(screen, f"{found.signal.name}: {samples}, noise {found.result.sigma:.4g}{unit}")
    if source.clean is not None:
        before, after, rmse = success(source, found).values()
        say(screen, f"SNR {before:.4f} dB before, {after:.4f} dB after, RMSE {rmse:.4g}")
    described = describe(found.result)
    if described:
        say(screen, f"{found.result.method}: {described}")


def describe(result: "Result") -> str:
    """What the method chose, its parameters, and what it found the noise to be."""
    told = [f"{name} {_word(value)}" for name, value in result.info.items()]
    noise = result.noise
    if noise is not None:
        if noise.most > 1.2 * noise.least:
            told.append(f"noise from {noise.least:.3g} to {noise.most:.3g} along the record")
        if noise.step:
            told.append(f"rounded to steps of {noise.step:.4g}")
        if noise.impulses > 0.0:
            told.append(f"{noise.impulses:.2%} impulses")
        if abs(noise.colour) > 0.05:
            told.append(f"coloured, AR(1) {noise.colour:.2f}")
    return ", ".join(told)


def _word(value: object) -> str:
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def print_comparison(screen: "Console", source: "Source", rows: "Sequence[Row]") -> None:
    """The table of all methods."""
    from rich.markup import escape
    from rich.table import Table

    known = {"SNR [dB]": "snr_after"} if source.clean is not None else {}
    columns = known | {
        "residual rms": "residual_rms",
        "robust": "residual_median",
        "roughness": "roughness",
        "CPU [s]": "cpu_time",
    }
    table = Table("method", *map(escape, columns), box=None)
    for row in rows:
        if "error" in row:
            table.add_row(str(row["method"]), escape(str(row["error"])))
            continue
        table.add_row(str(row["method"]), *(f"{row[key]:.4g}" for key in columns.values()))
    screen.print(table)
    screen.print(
        "robust: median size of the residual / 0.6745. The residual of a good estimate is the "
        "noise: both near sigma where there are no impulses. "
        "roughness: rms of the second difference."
    )


def print_filters(screen: "Console", source: "Source", rows: "Sequence[Row]") -> None:
    """The table of all filters of the loop, the best first."""
    from rich.markup import escape
    from rich.table import Table

    from fpt_ros.analysis.estimates import step_of

    unit = step_of(source)[1] or "samples"
    columns = {
        "value": "value",
        "velocity": "velocity",
        "acceleration": "acceleration",
        "score": "score",
        f"delay [{unit}]": "delay",
    }
    table = Table(box=None)
    table.add_column("filter", no_wrap=True)
    for heading in columns:
        table.add_column(escape(heading), justify="right")
    for row in rows:
        shown = (
            [str(row["error"])] if "error" in row else [f"{row[k]:.4g}" for k in columns.values()]
        )
        table.add_row(str(row["method"]), *map(escape, shown))
    screen.print(table)
    known = source.clean is not None
    truth = "the clean signal" if known else "what auto makes of the whole record"
    say(
        screen,
        f"value, velocity, acceleration: rms difference from {truth}, without the first tenth\n"
        "score: geometric mean of their ratios to the best of each; all filters at their defaults",
    )


def say(screen: "Console", line: str) -> None:
    """One line as it is: brackets are no markup."""
    screen.print(line, markup=False, soft_wrap=True)
