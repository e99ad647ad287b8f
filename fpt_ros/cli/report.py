"""``fpt report``."""

from pathlib import Path
from typing import Annotated

import typer

from fpt_ros.cli.options import Json

Bags = Annotated[list[Path], typer.Argument(metavar="BAG...", help="Recordings, side by side.")]
Out = Annotated[
    Path | None, typer.Option(metavar="DIR", help="Where to write; default: BAG-report beside BAG.")
]


def report(bags: Bags, out: Out = None, json: Json = False) -> None:
    """Metrics and figures of one recording, or of several side by side: one HTML page.

    Example: fpt report demo/adaptive demo/nonadaptive --out /tmp/report
    """
    from fpt_ros.analysis.recorded import read_outline
    from fpt_ros.analysis.report import write_report
    from fpt_ros.analysis.tables import console_table
    from fpt_ros.cli.output import console, print_json
    from fpt_ros.cli.recordings import say

    runs = [read_outline(bag) for bag in bags]
    for bag, run in zip(bags, runs, strict=True):
        say(bag, filter(None, run.info.get("missing", "").split("; ")))
    first = bags[0].absolute()
    page = write_report(runs, out or first.with_name(first.stem + "-report"))
    results = [
        {**(run.numbers or {}), "bag": str(bag)} for run, bag in zip(runs, bags, strict=True)
    ]
    if json:
        one = results[0] if len(results) == 1 else {"runs": results}
        print_json({**one, "report": str(page)})
        return
    console().print(console_table(results))
    console().print(f"report: {page}", soft_wrap=True)
