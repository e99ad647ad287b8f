"""``fpt denoise``."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from fpt_ros.cli.options import Json

if TYPE_CHECKING:
    from fpt_ros.analysis.signal_source import Source
    from fpt_ros.denoising.offline import Result

File = Annotated[
    Path,
    typer.Argument(metavar="FILE", help="A CSV or NPY file, a recording, or test:SIGNAL."),
]
Column = Annotated[str | None, typer.Option(metavar="C", help="Column; default: the last one.")]
Topic = Annotated[str | None, typer.Option(metavar="T", help="Topic of a recording.")]
Field = Annotated[str | None, typer.Option(metavar="F", help="Field, as in position[2].")]
Method = Annotated[
    str, typer.Option(metavar="M", help="Method; auto weighs several by their risk.")
]
Settings = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="PARAM=VALUE", help="Change a parameter of it; repeatable."),
]
Out = Annotated[
    Path | None, typer.Option(metavar="FILE", help="CSV to write; default: FILE-denoised.csv.")
]
Plot = Annotated[Path | None, typer.Option(metavar="FILE", help="Picture to draw (png, svg, pdf).")]
Compare = Annotated[bool, typer.Option("--compare", help="Run all methods and print the table.")]

PICTURES = (".png", ".svg", ".pdf")


def denoise(
    file: File,
    column: Column = None,
    topic: Topic = None,
    field: Field = None,
    method: Method = "auto",
    set_: Settings = None,
    out: Out = None,
    plot: Plot = None,
    compare: Compare = False,
    json: Json = False,
) -> None:
    """Denoise a signal: a column of a table, or a field of a recording's topic.

    Missing samples (empty, NaN) are healed and marked. The last column of the output is the
    estimate. test:SIGNAL is a test signal of chapters 5 and 6 with noise, whose SNR is printed.

    Example: fpt denoise signal.csv --column y --plot signal.png

    Example: fpt denoise /tmp/tora --topic /joint_states --field position[2] --out q3.csv

    Example: fpt denoise test:sines,rho=0.5,seed=10 --method improved --plot sines.png
    """
    from fpt_ros.analysis.signal_source import load
    from fpt_ros.cli.output import console, print_json
    from fpt_ros.errors import BadInput

    if plot is not None and plot.suffix not in PICTURES:
        raise BadInput(f"--plot {plot}: it takes a name that ends in {', '.join(PICTURES)}")
    source = load(file, column, topic, field)
    if compare:
        _compare(source, json)
        return
    target = out or source.path.with_name(f"{source.path.stem}-denoised.csv")
    if target.absolute() == file.absolute():
        raise BadInput(f"--out {target} is the input: give another name")
    result = _run(source, method, set_ or [])
    _write(source, result, target, plot)
    numbers = {
        "file": str(file),
        "signal": source.name,
        "method": result.method,
        "samples": len(source.values),
        "healed": int(result.healed.sum()),
        "sigma": result.sigma,
        **_success(source, result),
        "info": dict(result.info),
        "out": str(target),
        "plot": str(plot) if plot is not None else None,
    }
    if json:
        print_json(numbers)
        return
    healed = f", {numbers['healed']} of them healed" if numbers["healed"] else ""
    screen = console()
    screen.print(f"{source.name}: {numbers['samples']} samples{healed}, noise {result.sigma:.4g}")
    if source.clean is not None:
        before, after, rmse = _success(source, result).values()
        screen.print(f"SNR {before:.4f} dB before, {after:.4f} dB after, RMSE {rmse:.4g}")
    screen.print(f"estimate ({result.method}): {target}", soft_wrap=True)
    if plot is not None:
        screen.print(f"picture: {plot}", soft_wrap=True)


def _run(source: "Source", method: str, settings: list[str]) -> "Result":
    from fpt_ros.denoising.offline import denoise as run
    from fpt_ros.errors import BadInput
    from fpt_ros.experiments.parameter_file import scalar

    options = {}
    for text in settings:
        name, equals, value = text.partition("=")
        if not equals:
            raise BadInput(f"--set {text}: it takes PARAM=VALUE, as in level=4")
        options[name] = scalar(value)
    return run(source.values, method, **options)  # type: ignore[arg-type]  # checked in there


def _success(source: "Source", result: "Result") -> dict[str, float]:
    """How near to the clean signal, where that is known."""
    from fpt_ros.denoising.signals import rmse, snr_db

    if source.clean is None:
        return {}
    there = ~result.healed
    return {
        "snr_before": snr_db(source.clean[there], source.values[there]),
        "snr_after": snr_db(source.clean, result.estimate),
        "rmse": rmse(source.clean, result.estimate),
    }


def _write(source: "Source", result: "Result", target: Path, plot: Path | None) -> None:
    """Table and picture; each appears whole or not at all."""
    import io

    from fpt_ros.analysis.signal_figure import picture
    from fpt_ros.analysis.whole_files import write_whole
    from fpt_ros.errors import BadInput

    table = source.table.copy()
    table["healed"] = result.healed.astype(int)
    table["estimate"] = result.estimate
    text = io.StringIO()
    table.to_csv(text, index=False)
    try:
        write_whole(target, text.getvalue().encode())
        if plot is not None:
            write_whole(plot, picture(source, result, plot.suffix[1:]))
    except OSError as error:
        raise BadInput(f"{error.filename or target} cannot be written: {error.strerror}") from error


def _compare(source: "Source", json: bool) -> None:
    """All methods on one signal: noise that each leaves over, and time."""
    from time import process_time

    import numpy as np

    from fpt_ros.cli.output import console, print_json
    from fpt_ros.denoising.offline import DENOISERS
    from fpt_ros.errors import BadInput

    rows: list[dict[str, str | float]] = []
    for name in DENOISERS.names():
        started = process_time()
        try:
            result = _run(source, name, [])
        except BadInput as error:
            rows.append({"method": name, "error": str(error)})
            continue
        seconds = process_time() - started
        residual = source.values - result.estimate
        rough = float(np.sqrt(np.mean(np.diff(result.estimate, 2) ** 2)))
        rows.append(
            {
                "method": name,
                **_success(source, result),
                "sigma": result.sigma,
                "residual_rms": float(np.sqrt(np.nanmean(residual**2))),
                "residual_median": float(np.nanmedian(np.abs(residual))) / 0.6745,
                "roughness": rough,
                "cpu_time": seconds,
            }
        )
    if json:
        print_json({"signal": source.name, "samples": len(source.values), "methods": rows})
        return
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
            table.add_row(str(row["method"]), str(row["error"]))
            continue
        table.add_row(str(row["method"]), *(f"{row[key]:.4g}" for key in columns.values()))
    screen = console()
    screen.print(table)
    screen.print(
        "robust: median size of the residual / 0.6745. The residual of a good estimate is the "
        "noise: both near sigma where there are no impulses. "
        "roughness: rms of the second difference."
    )
