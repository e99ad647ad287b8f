"""``fpt denoise``."""

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

import typer

from fpt_ros.cli.options import Json

if TYPE_CHECKING:
    from fpt_ros.analysis.estimates import Estimate
    from fpt_ros.analysis.signal_source import Request, Source
    from fpt_ros.parameters import Value

File = Annotated[
    Path,
    typer.Argument(
        metavar="FILE", help="A table, - for standard input, a recording, or test:SIGNAL."
    ),
]
Column = Annotated[
    list[str] | None,
    typer.Option(
        metavar="NAME", help="Column, repeatable, or all; default: the last one of numbers."
    ),
]
Time = Annotated[
    str | None,
    typer.Option(
        metavar="NAME",
        help="Column of times; none: rows are equally spaced. Of a recording: header.stamp.",
    ),
]
Topic = Annotated[str | None, typer.Option(metavar="T", help="Topic of a recording.")]
Field = Annotated[str | None, typer.Option(metavar="F", help="Field, as in position[2].")]
Joint = Annotated[
    str | None,
    typer.Option(metavar="NAME", help="Joint of a recording, by name; --field is its array."),
]
Method = Annotated[
    str, typer.Option(metavar="M", help="Method; auto weighs several by their risk.")
]
Settings = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="PARAM=VALUE", help="Change a parameter of it; repeatable."),
]
Out = Annotated[
    Path | None,
    typer.Option(
        metavar="FILE",
        help="Table to write (csv, tsv, parquet, npz; - for standard output); default: "
        "FILE-denoised.csv.",
    ),
]
Plot = Annotated[Path | None, typer.Option(metavar="FILE", help="Picture to draw (png, svg, pdf).")]
Derivative = Annotated[
    int, typer.Option(metavar="1|2", help="Also the derivative of the estimate by time.")
]
Compare = Annotated[bool, typer.Option("--compare", help="Run all methods and print the table.")]
Streaming = Annotated[
    str | None,
    typer.Option(
        metavar="FILTER",
        help="A filter of the loop instead of a method, sample by sample; with --compare: all.",
    ),
]

ALL = "all"
LONG_TEXT, LONG_RECORD = 20_000_000, 50_000
"""Bytes and samples from which on progress is shown."""


def denoise(
    file: File,
    column: Column = None,
    time: Time = None,
    topic: Topic = None,
    field: Field = None,
    joint: Joint = None,
    method: Method = "auto",
    set_: Settings = None,
    out: Out = None,
    derivative: Derivative = 0,
    plot: Plot = None,
    compare: Compare = False,
    streaming: Streaming = None,
    json: Json = False,
) -> None:
    """Denoise a signal: a column of a table, or a field of a recording's topic.

    Tables are CSV and other text with any separator and decimal mark, JSON, NPY, NPZ, Parquet, MAT
    and WAV, compressed or not. Header, units, comments and the column of times are found, and told.
    Rows may be in any order, and may lack samples: missing ones (empty, NaN, words) are healed and
    marked. The output has all columns of the table, then healed and estimate.

    test:SIGNAL is a test signal of chapters 5 and 6 with noise, whose SNR is printed.

    Example: fpt denoise signal.csv --column y --plot signal.png

    Example: fpt denoise log.tsv.gz --column all --time stamp --out smooth.parquet

    Example: fpt denoise encoder.csv --column angle --derivative 1

    Example: zcat log.csv.gz | fpt denoise - > smooth.csv

    Example: fpt denoise /tmp/tora --topic /joint_states --field position[2] --out q3.csv

    Example: fpt denoise robot.mcap --topic /joint_states --field effort --joint elbow

    Example: fpt denoise encoder.csv --streaming kalman_bank --derivative 1

    Example: fpt denoise encoder.csv --streaming all --compare

    Example: fpt denoise test:sines,rho=0.5,seed=10 --method improved --plot sines.png
    """
    from fpt_ros.analysis.signal_source import Request
    from fpt_ros.cli.denoise_files import picture_path, targets, write

    target, pictures = targets(file, out, plot, compare, json)
    request = Request(file, tuple(column or ()), topic, field, time, joint)
    filters = _filter_of(streaming, method, compare)
    source = _load(request)
    if compare:
        _compare(source, streaming is not None, json)
        return
    options = _options(set_ or [])
    how = Wanted(filters or method, filters is not None, options, derivative)
    found = _estimates(source, how, every="all" in request.columns)
    paths = [picture_path(pictures, one, len(found)) for one in found] if pictures else []
    write(source, found, target, paths)
    _tell(source, found, file, target, paths, json)


class Wanted(NamedTuple):
    """What is to be done with each signal: a method, or a filter sample by sample."""

    name: str
    streaming: bool
    options: "dict[str, Value]"
    derivative: int


def _filter_of(streaming: str | None, method: str, compare: bool) -> str | None:
    """The filter that is asked for, by its registered name.

    Raises:
        BadInput: there is none of that name, or a method is asked for beside it.
    """
    from fpt_ros.denoising.streaming import FILTERS
    from fpt_ros.errors import BadInput

    if streaming is None:
        return None
    if method != "auto":
        raise BadInput("--method is for whole records, --streaming for the loop: give one of them")
    if streaming == ALL:
        if not compare:
            raise BadInput("--streaming all compares the filters: add --compare, or name one")
        return None
    if compare:
        raise BadInput("--compare runs all filters: --streaming all")
    FILTERS[streaming]  # refuses an unknown name, and says which there are
    return streaming


def _load(request: "Request") -> "Source":
    """The signals; with a bar where the file is long."""
    from fpt_ros.analysis.signal_source import load
    from fpt_ros.cli.output import progress_bar

    path = request.path
    size = path.stat().st_size if path.is_file() else 0
    if size < LONG_TEXT:
        return load(request)
    with progress_bar(f"reading {path.name}", size, "bytes") as done:
        return load(request, lambda count: done(min(count, size)))


def _options(settings: list[str]) -> "dict[str, Value]":
    from fpt_ros.errors import BadInput
    from fpt_ros.experiments.parameter_file import scalar

    options: dict[str, Any] = {}
    for text in settings:
        name, equals, value = text.partition("=")
        if not equals:
            raise BadInput(f"--set {text}: it takes PARAM=VALUE, as in level=4")
        options[name] = scalar(value)  # checked by the method
    return options


def _estimates(source: "Source", how: Wanted, every: bool) -> "list[Estimate]":
    """The estimates; where all columns are asked for, those that can be had.

    Raises:
        BadInput: a signal cannot be denoised, or none of all.
    """
    from fpt_ros.analysis.estimates import estimate
    from fpt_ros.analysis.filtered import filtered
    from fpt_ros.errors import BadInput

    found, refused = [], []
    name, streaming, options, derivative = how
    for signal in source.signals:
        try:
            if streaming:
                found.append(filtered(source, signal, name, options, derivative))
                continue
            with _working(signal.name, len(source.table)) as progress:
                found.append(estimate(source, signal, name, options, progress, derivative))
        except BadInput as error:
            if not every:
                raise
            refused.append(error)
            print(f"fpt: note: {signal.name} is left out: {error}", file=sys.stderr)
    if not found:
        raise refused[0]
    return found


@contextmanager
def _working(name: str, samples: int) -> Iterator[Callable[..., None] | None]:
    """Progress of a method on a long record."""
    from fpt_ros.cli.output import progress_bar

    if samples < LONG_RECORD:
        yield None
        return
    with progress_bar(f"denoising {name}", samples, "samples") as done:
        yield done


def _tell(
    source: "Source",
    found: "list[Estimate]",
    file: Path,
    target: Path,
    pictures: list[Path],
    json: bool,
) -> None:
    from rich.console import Console

    from fpt_ros.analysis.estimates import remarks
    from fpt_ros.cli import denoise_summary as summary
    from fpt_ros.cli.output import console, print_json

    plots = [str(path) for path in pictures]
    drawn: list[str | None] = [*plots] if plots else [None] * len(found)
    if json:
        signals = [summary.numbers(source, one) for one in found]
        for signal, plot in zip(signals, drawn, strict=True):
            signal["plot"] = plot
        print_json(
            {
                "file": str(file),
                "read": source.table.layout,
                "times": summary.times(source),
                "remarks": remarks(source),
                **(signals[0] if len(signals) == 1 else {"signals": signals}),
                "out": str(target),
            }
        )
        return
    to_stdout = str(target) == "-"
    screen = Console(stderr=True, highlight=False) if to_stdout else console()
    summary.print_source(screen, source)
    for one in found:
        summary.print_found(screen, source, one)
    if not to_stdout:
        summary.say(screen, f"estimate ({found[0].result.method}): {target}")
    for plot in plots:
        summary.say(screen, f"picture: {plot}")


def _compare(source: "Source", streaming: bool, json: bool) -> None:
    from fpt_ros.analysis.compared_methods import compare
    from fpt_ros.analysis.filtered import compare_filters
    from fpt_ros.cli import denoise_summary as summary
    from fpt_ros.cli.output import console, print_json
    from fpt_ros.errors import BadInput

    if len(source.signals) > 1:
        raise BadInput("--compare takes one signal: give one --column")
    signal = source.signals[0]
    rows = compare_filters(source, signal) if streaming else compare(source, signal)
    if json:
        kinds = "filters" if streaming else "methods"
        print_json({"signal": signal.name, "samples": len(source.table), kinds: rows})
        return
    screen = console()
    summary.print_source(screen, source)
    if streaming:
        summary.print_filters(screen, source, rows)
    else:
        summary.print_comparison(screen, source, rows)
