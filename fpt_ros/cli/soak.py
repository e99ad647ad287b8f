"""``fpt soak``."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from fpt_ros.cli.options import Json

if TYPE_CHECKING:
    from fpt_ros.nodes.soak import Tally

Minutes = Annotated[float, typer.Option("--minutes", metavar="M", min=0.0, help="How long.")]
Seed = Annotated[int, typer.Option("--seed", metavar="S", help="Of the faults.")]
Keep = Annotated[
    Path | None,
    typer.Option("--keep", metavar="DIR", help="Where recordings of runs that went wrong stay."),
]


def soak(minutes: Minutes = 5.0, seed: Seed = 1, keep: Keep = None, json: Json = False) -> None:
    """Inject random faults into runs of the graph: killed and frozen nodes, foreign messages.

    The runs are in lockstep, in this ROS domain. Exit status 1 where anything was not survived, a
    message is lost, or a number is another than that of an undisturbed run.

    Example: fpt soak --minutes 15 --seed 7
    """
    import tempfile

    from fpt_ros.cli.output import print_json
    from fpt_ros.nodes import soak as soaking

    folder = keep or Path(tempfile.mkdtemp(prefix="fpt_ros-soak-"))
    folder.mkdir(parents=True, exist_ok=True)
    tally = soaking.soak(60.0 * minutes, seed, folder, _tell)
    if tally.good and not any(folder.iterdir()):
        folder.rmdir()
    if json:
        print_json({**vars(tally), "equal": tally.unequal == 0, "good": tally.good})
    else:
        _print(tally)
    if not tally.good:
        typer.echo(f"fpt: not everything was survived, see {folder}", err=True)
        raise typer.Exit(1)


def _tell(line: str) -> None:
    typer.echo(line, err=True)


def _print(tally: "Tally") -> None:
    from rich import box
    from rich.table import Table
    from rich.text import Text

    from fpt_ros.cli.output import console

    table = Table(box=box.SIMPLE_HEAD)
    table.add_column("fault")
    table.add_column("injected", justify="right")
    table.add_column("survived", justify="right")
    for fault, count in tally.injected.items():
        table.add_row(Text(fault), str(count), str(tally.survived[fault]))
    table.add_row("all", str(sum(tally.injected.values())), str(sum(tally.survived.values())))
    out = console()
    out.print(table)
    equal = "yes" if not tally.unequal else f"not of {tally.unequal} runs"
    out.print(
        f"{tally.runs} runs, {tally.cycles} cycles, {tally.lost} messages lost, numbers equal: "
        f"{equal}"
    )
    for problem in tally.problems:
        out.print(Text(problem))
