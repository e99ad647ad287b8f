"""``fpt reproduce``: the thesis's claims, judged by runs, on one page."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from fpt_ros.cli.options import Json

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from rich.table import Table

    from fpt_ros.thesis.chapters import Chapter
    from fpt_ros.thesis.judging import Outcome

Chapters = Annotated[
    list[int] | None,
    typer.Option("--chapter", metavar="N", help="Of the thesis; repeatable; default: all."),
]
Claims = Annotated[
    list[str] | None,
    typer.Option("--claim", metavar="ID", help="As the page names it (3.1.1a); repeatable."),
]
Out = Annotated[Path, typer.Option(metavar="DIR", help="Where the page goes.")]

COLOURS = {"yes": "green", "only if": "yellow", "no": "red"}


def reproduce(
    chapter: Chapters = None,
    claim: Claims = None,
    out: Out = Path("reproduction"),
    json: Json = False,
) -> None:
    """Run the experiments of the thesis and judge each of its claims: one HTML page.

    Example: fpt reproduce --chapter 3 --out /tmp/reproduction
    """
    from time import perf_counter

    from fpt_ros.cli.output import console, print_json, progress_bar
    from fpt_ros.thesis.chapters import wanted
    from fpt_ros.thesis.claims_json import as_json
    from fpt_ros.thesis.judging import judge_all
    from fpt_ros.thesis.page import check_directory, write_page

    asked = wanted(chapter or (), claim or ())
    check_directory(out)
    started = perf_counter()
    total = sum(len(one.claims) for one in asked)
    with progress_bar("reproduce", total, "claims") as bar:
        found = judge_all(asked, bar)
    page = write_page(asked, found, out, perf_counter() - started)
    if json:
        print_json({**as_json(asked, found), "page": str(page)})
        return
    console().print(_table(asked, found))
    console().print(f"page: {page}", soft_wrap=True)


def _table(asked: "Sequence[Chapter]", found: "Mapping[str, Outcome]") -> "Table":
    """The verdicts for the terminal."""
    from rich import box
    from rich.table import Table
    from rich.text import Text

    table = Table(box=box.SIMPLE_HEAD)
    for heading in ("", "claim", "reproduces"):
        table.add_column(heading)
    for one in asked:
        for name, judged in one.claims.items():
            status = found[name].verdict.status
            table.add_row(name, Text(judged.text), Text(status, COLOURS[status]))
        table.add_section()
    return table
