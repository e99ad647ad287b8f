"""``fpt sweep``."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Annotated, Any

import typer

from fpt_ros.cli.options import Duration, Json, Name, Settings, Variant

if TYPE_CHECKING:
    from fpt_ros.sweep.sweep import Progress

Grid = Annotated[
    list[str] | None,
    typer.Option(
        metavar="NODE.PARAM=RANGE",
        help="What is varied: START:STOP:COUNT, START:STOP:COUNT:log or A,B,C; "
        "PARAM[0] is an element of a list; repeatable.",
    ),
]
Random = Annotated[
    int | None,
    typer.Option(metavar="N", help="N random points within the ranges instead of their product."),
]
Seed = Annotated[int, typer.Option(metavar="S", help="Random seed of --random.")]
Metrics = Annotated[
    list[str] | None,
    typer.Option(
        "--metric",
        metavar="NAME",
        help="Columns: rms_settled.q3, max_settled, effort.q1, chatter; repeatable; default: all.",
    ),
]
Out = Annotated[
    Path | None,
    typer.Option(metavar="DIR", help="Where to write, or to go on; default: NAME-sweep."),
]
Scheduler = Annotated[
    str | None, typer.Option(metavar="ADDRESS", help="A dask scheduler: run on its workers.")
]
Workers = Annotated[
    int | None, typer.Option(metavar="N", help="Processes; default: as many as cores.")
]

QUIET = 10.0
"""Seconds between two lines of progress where standard error is no terminal."""


def sweep(
    name: Name,
    variant: Variant = "adaptive",
    set_: Settings = None,
    duration: Duration = None,
    grid: Grid = None,
    random: Random = None,
    seed: Seed = 0,
    metric: Metrics = None,
    out: Out = None,
    scheduler: Scheduler = None,
    workers: Workers = None,
    json: Json = False,
) -> None:
    """Run thousands of variants on all cores: one table, one map. The same command goes on.

    Example: fpt sweep tora --grid fpt_deformer.A=-0.1:-6:64 --out /tmp/tora
    """
    from fpt_ros.cli.interrupts import collected
    from fpt_ros.errors import Interrupted
    from fpt_ros.sweep import sweep as sweeps
    from fpt_ros.sweep.definition import define
    from fpt_ros.sweep.directory import open_directory
    from fpt_ros.sweep.executor import local_workers, pool

    local_workers(workers)
    asked = define(name, variant, set_ or (), duration, grid or (), random, seed, metric or ())
    title = f"{asked.experiment.name} {asked.experiment.variant}"
    directory = out or Path(f"{asked.experiment.name}-sweep")
    started = perf_counter()
    with collected() as interrupted, pool(scheduler, workers) as executor:
        resumed = open_directory(asked.definition, directory)
        known: list[int] = []  # runs that were there before
        with progress(title, asked.size) as bar:

            def look(done: int, lost: int) -> None:
                if not known:
                    known.append(done)
                bar(done, lost)
                if interrupted:
                    raise Interrupted(
                        f"interrupted after {done} of {asked.size} runs: the same command goes on"
                    )

            journal = sweeps.run(asked, directory, executor, look)
    seconds = perf_counter() - started
    with journal:
        from fpt_ros.sweep.maps import draw
        from fpt_ros.sweep.table import write_tables

        table, binary = write_tables(asked, journal, directory)
        onset, pictures = draw(asked, binary, directory)
        made = asked.size - known[0]
        result: dict[str, Any] = {
            "experiment": asked.experiment.name,
            "variant": asked.experiment.variant,
            "runs": asked.size,
            "made": made,
            "resumed": resumed,
            "not_complete": journal.lost,
            "onset_of_chattering": onset,
            "wall_time": seconds,
            "runs_per_second": made / seconds,
            "table": str(table),
            "parquet": str(binary),
            "map": [str(path) for path in pictures],
        }
    _print(result, title, binary, json)


def _print(result: dict[str, Any], title: str, binary: Path, json: bool) -> None:
    from fpt_ros.cli.output import console, print_json
    from fpt_ros.sweep.results import best

    result["best"] = best(binary)
    if json:
        print_json(result)
        return
    print(
        f"{title}: {result['runs']} runs, {result['not_complete']} of them not complete; "
        f"{result['made']} made in {result['wall_time']:.1f} s, "
        f"{result['runs_per_second']:.1f} runs/s"
    )
    if result["onset_of_chattering"]:
        inside, beyond = result["onset_of_chattering"]
        print(f"onset of chattering between {inside:.6g} and {beyond:.6g}")
    for metric, row in result["best"].items():
        at = ", ".join(f"{key} = {value}" for key, value in row["at"].items())
        print(f"least {metric}: {row['value']:.4g} at {at}")
    console().print(f"table: {result['table']}   map: {result['map'][0]}", soft_wrap=True)


@contextmanager
def progress(what: str, total: int, of: str = "runs") -> Iterator["Progress"]:
    """A bar on standard error with rate and time left; on a pipe a line every now and then."""
    if not sys.stderr.isatty():
        yield _lines(what, total, of)
        return
    from rich.console import Console
    from rich.progress import (
        BarColumn,
        MofNCompleteColumn,
        Progress,
        TextColumn,
        TimeElapsedColumn,
        TimeRemainingColumn,
    )

    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TextColumn(of + ", {task.fields[lost]} not complete"),
        TimeElapsedColumn(),
        TimeRemainingColumn(),
    )
    with Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task(what, total=total, lost=0)
        yield lambda done, lost: bar.update(task, completed=done, lost=lost)


def _lines(what: str, total: int, of: str) -> "Progress":
    started = last = perf_counter()
    first: int | None = None
    print(f"{what}: {total} {of}", file=sys.stderr)

    def tell(done: int, lost: int) -> None:
        nonlocal last, first
        now = perf_counter()
        first = done if first is None else first
        if now - last < QUIET or done == first:
            return
        last = now
        rate = (done - first) / (now - started)
        left = (total - done) / rate
        print(
            f"{what}: {done} of {total} {of}, {lost} not complete, {rate:.1f} {of}/s, "
            f"{left:.0f} s left",
            file=sys.stderr,
            flush=True,
        )

    return tell
