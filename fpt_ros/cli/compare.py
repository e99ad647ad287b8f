"""``fpt compare``."""

import shlex
import sys
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Annotated

import typer

from fpt_ros.cli.options import Duration, Json, Name, Settings

if TYPE_CHECKING:
    from fpt_ros.compare.results import Results

Controllers = Annotated[
    list[str] | None,
    typer.Option(metavar="A,B,...", help="Variants or overlay files; default: all that fit."),
]
Circumstances = Annotated[
    list[str] | None,
    typer.Option(
        "--variants", metavar="A,B,...", help="Circumstances that they meet; default: all; or none."
    ),
]
Tune = Annotated[bool, typer.Option("--tune", help="Tune every controller first, all alike.")]
Trials = Annotated[
    int | None, typer.Option(metavar="N", help="Of the tuning of a controller; default: 32.")
]
Limit = Annotated[
    float | None,
    typer.Option(
        metavar="STEP", help="Of the efforts' mean step while tuning; default: 10 times the usual."
    ),
]
Hold = Annotated[
    list[str] | None,
    typer.Option(
        metavar="NODE.PARAM,...",
        help="Not tuned, as trajectory_generator.lambda for one prescription for all.",
    ),
]
Seed = Annotated[int, typer.Option(metavar="S", help="Random seed of noise and search.")]
Out = Annotated[
    Path | None,
    typer.Option(metavar="DIR", help="Where to write, or to go on; default: NAME-compare."),
]
Workers = Annotated[
    int | None, typer.Option(metavar="N", help="Processes; default: as many as cores.")
]


def compare(
    name: Name,
    controllers: Controllers = None,
    variants: Circumstances = None,
    set_: Settings = None,
    duration: Duration = None,
    tune: Tune = False,
    trials: Trials = None,
    limit: Limit = None,
    hold: Hold = None,
    seed: Seed = 0,
    out: Out = None,
    workers: Workers = None,
    json: Json = False,
) -> None:
    """Compare all controllers of an experiment under all its circumstances: one page.

    The same command goes on after Ctrl-C. With --tune every controller has the same number of
    trials, on other seeds than those shown.

    Example: fpt compare panda --tune --out /tmp/panda
    """
    from fpt_ros.cli.interrupts import collected
    from fpt_ros.cli.output import console, print_json
    from fpt_ros.cli.sweep import progress
    from fpt_ros.compare import compare as comparisons
    from fpt_ros.compare.page import as_json, write_page
    from fpt_ros.compare.results import results_of
    from fpt_ros.errors import BadInput, Interrupted
    from fpt_ros.sweep.executor import LocalPool, local_workers

    local_workers(workers)
    for option, value in (("--trials", trials), ("--limit", limit), ("--hold", hold)):
        if value is not None and not tune:
            raise BadInput(f"{option} is of --tune: give both")
    if trials is not None and trials < 1:
        raise BadInput(f"--trials {trials} is not valid, it takes 1 or more")
    if limit is not None and not 0.0 < limit < float("inf"):
        raise BadInput(f"--limit {limit:g} is not valid, it takes a number > 0")
    if not 0 <= seed < 2**31:
        raise BadInput(f"--seed {seed} is not valid, it takes 0 to {2**31 - 1}")
    budget = (trials or comparisons.TRIALS) if tune else 0
    asked = comparisons.define(
        name,
        _words(controllers),
        _words(variants),
        set_ or (),
        duration,
        budget,
        seed,
        limit,
        _words(hold),
    )
    directory = out or Path(f"{asked.plan.field.experiment.name}-compare")
    started = perf_counter()
    with collected() as interrupted, LocalPool(local_workers(workers)) as pool:
        title = f"compare {asked.plan.field.experiment.name}"
        with progress(title, asked.size, "controllers") as bar:

            def look(done: int, lost: int) -> None:
                bar(done, lost)
                if interrupted:
                    raise Interrupted(
                        f"interrupted after {done} of {asked.size} controllers: "
                        "the same command goes on"
                    )

            rows = comparisons.run(asked, directory, pool, look)
    results = results_of(asked, rows)
    page = write_page(results, directory, shlex.join(["fpt", *sys.argv[1:]]))
    if json:
        print_json({**as_json(results), "page": str(page)})
        return
    _print(results)
    screen = console()
    screen.print(f"{asked.size} controllers in {perf_counter() - started:.0f} s")
    screen.print(f"page: {page}", soft_wrap=True)


def _words(texts: list[str] | None) -> list[str]:
    return [part.strip() for text in texts or () for part in text.split(",") if part.strip()]


def _print(results: "Results") -> None:
    from rich.table import Table
    from rich.text import Text

    from fpt_ros.cli.output import console
    from fpt_ros.compare.page import number_words, percent_words
    from fpt_ros.compare.verdicts import verdicts

    circumstances = results.asked.plan.field.circumstances
    table = Table(box=None, pad_edge=False)
    table.add_column("controller")
    for heading in ("error, rms", "largest", "effort", "chatter", "saturated", "µs/cycle"):
        table.add_column(heading, justify="right")
    for cell in results.of(circumstances[0]):
        table.add_row(
            Text(cell.controller.name, "bold" if cell.controller.family else ""),
            Text(number_words(cell.error), "red" if cell.verdict else ""),
            *map(number_words, (cell.max, cell.effort, cell.step)),
            percent_words(cell.cut),
            "–" if cell.cost is None else f"{cell.cost:.1f}",
        )
    console().print(table)
    for each in verdicts(results):
        console().print(f"{each.circumstance.name}: {each.kind}; {each.text}", soft_wrap=True)
