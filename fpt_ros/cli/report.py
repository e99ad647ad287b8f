"""``fpt report``."""

from pathlib import Path
from typing import Annotated

import typer

from fpt_ros.cli.options import Json

Bags = Annotated[list[Path], typer.Argument(metavar="BAG...", help="Recordings, side by side.")]
Out = Annotated[
    Path | None, typer.Option(metavar="DIR", help="Where to write; default: BAG-report beside BAG.")
]
Formats = Annotated[
    str,
    typer.Option(
        "--format",
        metavar="F,F",
        help="Figures for print as well, in figures/: svg, pdf, png, or several, as svg,pdf.",
    ),
]


def report(bags: Bags, out: Out = None, format_: Formats = "", json: Json = False) -> None:
    """Metrics and plots of one recording, or of several side by side: one page to zoom in.

    Example: fpt report demo/adaptive demo/nonadaptive --out /tmp/report --format pdf
    """
    from fpt_ros.analysis.recorded import read_outline
    from fpt_ros.analysis.report import FORMATS, write_report
    from fpt_ros.analysis.tables import console_table
    from fpt_ros.cli.output import console, print_json
    from fpt_ros.cli.recordings import say
    from fpt_ros.errors import BadInput

    formats = tuple(dict.fromkeys(filter(None, format_.lower().replace(" ", "").split(","))))
    for each in formats:
        if each not in FORMATS:
            raise BadInput(f"--format {each}: it has to be one of {', '.join(FORMATS)}")
    runs = [read_outline(bag) for bag in bags]
    for bag, run in zip(bags, runs, strict=True):
        say(bag, filter(None, run.info.get("missing", "").split("; ")))
    first = bags[0].absolute()
    page = write_report(runs, out or first.with_name(first.stem + "-report"), formats)
    results = [
        {**(run.numbers or {}), "bag": str(bag)} for run, bag in zip(runs, bags, strict=True)
    ]
    if json:
        one = results[0] if len(results) == 1 else {"runs": results}
        print_json({**one, "report": str(page)})
        return
    console().print(console_table(results))
    console().print(f"report: {page}", soft_wrap=True)
