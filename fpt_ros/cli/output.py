"""What commands print: a table for people, or one JSON object for programs; progress on stderr."""

import json
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    from rich.console import Console


class Progress(Protocol):
    """Is told how much is done, in cycles or whatever is counted."""

    def __call__(self, done: int) -> None:
        """``done`` of the total."""


def print_json(result: Mapping[str, Any]) -> None:
    """One JSON object on standard output."""
    print(json.dumps(result, indent=2, allow_nan=False))


def console() -> "Console":
    """Standard output for tables."""
    from rich.console import Console

    return Console(highlight=False, soft_wrap=False)


@contextmanager
def progress_bar(what: str, total: int, of: str = "cycles") -> Iterator[Progress]:
    """A bar on standard error with rate and time left; on a pipe nothing but its first line."""
    if not sys.stderr.isatty():
        print(f"{what}: {total} {of}", file=sys.stderr)
        yield lambda done: None
        return
    from rich.console import Console
    from rich.progress import (
        BarColumn,
        MofNCompleteColumn,
        TextColumn,
        TimeElapsedColumn,
        TimeRemainingColumn,
    )
    from rich.progress import Progress as Bar

    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TextColumn(of),
        TimeElapsedColumn(),
        TimeRemainingColumn(),
    )
    with Bar(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task(what, total=total)
        yield lambda done: bar.update(task, completed=done)


def print_result(result: Mapping[str, Any], as_json: bool) -> None:
    """The result of one run: JSON, or a table of errors and where the recording is."""
    if as_json:
        print_json(result)
        return
    from fpt_ros.analysis.tables import console_table

    out = console()
    out.print(console_table([result]))
    rate = result["cycles_per_second"]
    speed = f", {rate:,.0f} cycles/s" if rate else ""
    out.print(f"{result['cycles']} cycles in {result['wall_time']:.1f} s{speed}")
    if result["bag"]:
        out.print(f"recorded: {result['bag']}   (fpt report {result['bag']})")
