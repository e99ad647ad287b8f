"""``fpt reproduce``."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from fpt_ros.cli.options import Json

if TYPE_CHECKING:
    from fpt_ros.reproduction import Group
    from fpt_ros.reproduction.work import Done

Chapter = Annotated[
    int | None, typer.Option(metavar="N", help="One chapter only (2, 3 or 4); default: all.")
]
Out = Annotated[Path, typer.Option(metavar="DIR", help="Where the page goes.")]


def reproduce(chapter: Chapter = None, out: Out = Path("reproduction"), json: Json = False) -> None:
    """Run every experiment of the thesis, and judge its claims on one page.

    Example: fpt reproduce --chapter 3 --out /tmp/chapter3
    """
    from time import perf_counter

    from fpt_ros.cli.output import console, print_json
    from fpt_ros.errors import BadInput
    from fpt_ros.reproduction import page
    from fpt_ros.reproduction.chapters import CHAPTERS

    if chapter is not None and chapter not in CHAPTERS:
        valid = ", ".join(map(str, CHAPTERS))
        raise BadInput(f"--chapter {chapter}: there are the chapters {valid}")
    wanted = {n: groups for n, groups in CHAPTERS.items() if chapter in (None, n)}
    started = perf_counter()
    done = _work([group for groups in wanted.values() for group in groups])
    parts: list[page.Section] = []
    for number, groups in wanted.items():
        parts += page.sections(number, groups, [done[group.title] for group in groups])
    path = page.write(parts, out, perf_counter() - started)
    if json:
        print_json({**page.as_json(parts), "page": str(path)})
        return
    from rich.table import Table
    from rich.text import Text

    table = Table("section", "claim", "reproduces", "measured", box=None, pad_edge=False)
    colours = {"yes": "green", "only if": "yellow", "no": "red"}
    for part in parts:
        for one in part.judged:
            status = Text(one.verdict.status, colours[one.verdict.status])
            table.add_row(one.claim.section, one.claim.text, status, one.verdict.measured)
    screen = console()
    screen.print(table)
    screen.print(f"page: {path} ({perf_counter() - started:.0f} s)", soft_wrap=True)


def _work(groups: "list[Group]") -> "dict[str, Done]":
    """All groups, side by side on all cores; Ctrl-C ends the workers."""
    import os
    from concurrent.futures import ProcessPoolExecutor, as_completed
    from multiprocessing import get_context

    from fpt_ros.cli.output import progress_bar
    from fpt_ros.reproduction.chapters import work_by_title

    cost = {group.title: len(group.cases) for group in groups}
    total = sum(cost.values())
    done: dict[str, Done] = {}
    pool = ProcessPoolExecutor(os.cpu_count(), mp_context=get_context("spawn"))
    try:
        # the longest first, so that no core waits for it at the end
        order = sorted(groups, key=lambda group: -len(group.cases))
        futures = {pool.submit(work_by_title, group.title): group for group in order}
        with progress_bar("reproduce", total, "runs") as show:
            finished = 0
            for future in as_completed(futures):
                group = futures[future]
                done[group.title] = future.result()
                finished += cost[group.title]
                show(finished)
    except BaseException:
        for process in list(pool._processes.values()):  # they would finish their groups first
            process.terminate()
        pool.shutdown(wait=True, cancel_futures=True)
        raise
    pool.shutdown()
    return done
