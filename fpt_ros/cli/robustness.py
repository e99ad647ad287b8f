"""``fpt robustness``."""

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated

import typer

from fpt_ros.cli.options import Json, Name, Settings, experiment_of

Variants = Annotated[
    list[str] | None,
    typer.Option("--variant", metavar="NAME|FILE.yaml", help="Side by side; repeatable."),
]
Points = Annotated[int, typer.Option(metavar="N", min=2, max=1000, help="Cases a row.")]
Tolerance = Annotated[
    float,
    typer.Option(metavar="PART", min=1e-9, help="Settled rms error / size of the motion allowed."),
]
Plot = Annotated[
    Path | None, typer.Option(metavar="FILE", help="Draw the picture: FILE.png or FILE.svg.")
]
Workers = Annotated[
    int | None, typer.Option(metavar="N", min=1, help="Processes; by default one a core.")
]

KINDS = (".png", ".svg")

Found = dict[str, Mapping[str, float]]
"""Variant -> criterion -> share."""


def robustness(
    name: Name,
    variant: Variants = None,
    set_: Settings = None,
    points: Points = 11,
    tolerance: Tolerance = 0.05,
    plot: Plot = None,
    workers: Workers = None,
    json: Json = False,
) -> None:
    """Count what a loop bears: wrong models, noise, torques, delay, kicks (RealAIGym's protocol).

    Example: fpt robustness pendubot --variant adaptive --variant nonadaptive --plot /tmp/bars.png
    """
    import sys

    from fpt_ros.errors import BadInput
    from fpt_ros.extras import need
    from fpt_ros.robustness.scores import results_of, scores
    from fpt_ros.sweep.executor import pool

    if plot is not None:
        if plot.suffix.lower() not in KINDS:
            raise BadInput(f"--plot {plot}: it takes a name that ends with .png or .svg")
        need("analysis")
    experiments = {
        each: experiment_of(name, each, set_, None, None) for each in variant or ["adaptive"]
    }

    def progress(done: int, total: int) -> None:
        if sys.stderr.isatty():
            print(f"\r{label}: {done} of {total} runs", end="", file=sys.stderr)

    found: Found = {}
    details = {}
    with pool(None, workers) as processes:
        for label, experiment in experiments.items():
            details[label] = results_of(experiment, points, processes, progress)
            found[label] = scores(details[label], tolerance)
            if sys.stderr.isatty():
                print(file=sys.stderr)
    about = experiments[next(iter(found))].about
    title = f"{about['title']}: error below {tolerance:.3g} of the motion"
    if plot is not None:
        _draw(found, title, plot)
    if json:
        from fpt_ros.analysis.sizes import finite
        from fpt_ros.cli.output import print_json

        cases = {
            label: [
                {
                    "criterion": each.case.criterion,
                    "case": each.case.what,
                    "error": finite(each.error),
                    "reason": each.reason,
                }
                for each in results
            ]
            for label, results in details.items()
        }
        print_json({"tolerance": tolerance, "scores": found, "cases": cases})
        return
    _print(found, title)
    if plot is not None:
        print(f"picture: {plot}")


def _print(found: Found, title: str) -> None:
    from rich.table import Table

    from fpt_ros.cli.output import console

    table = Table(title=title, title_justify="left")
    table.add_column("criterion")
    for label in found:
        table.add_column(label, justify="right")
    for criterion in next(iter(found.values())):
        table.add_row(criterion, *(f"{each[criterion]:.0%}" for each in found.values()))
    console().print(table)


def _draw(found: Found, title: str, path: Path) -> None:
    from fpt_ros.errors import BadInput
    from fpt_ros.robustness.figure import figure

    picture = figure(found, title)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        kind = path.suffix.lower().removeprefix(".")
        picture.savefig(path, metadata={"Date": None} if kind == "svg" else {})
    except OSError as error:
        raise BadInput(
            f"cannot write {path}: {error.strerror or error}, give a name that can be written"
        ) from error
