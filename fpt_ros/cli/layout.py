"""``fpt layout``."""

from pathlib import Path
from typing import Annotated

import typer

Bag = Annotated[Path, typer.Argument(metavar="BAG", help="A recording of a loop.")]
For = Annotated[str, typer.Option("--for", metavar="foxglove|plotjuggler", help="The program.")]
Out = Annotated[
    Path | None, typer.Option(metavar="FILE", help="Where to write; default: BAG.json or BAG.xml.")
]


def layout(bag: Bag, program: For = "foxglove", out: Out = None) -> None:
    """Make a layout for Foxglove, Lichtblick or PlotJuggler: a tab a joint, labels with units.

    PlotJuggler's is of the file that fpt export --format mcap makes.

    Example: fpt layout /tmp/tora --for plotjuggler --out tora.xml
    """
    from fpt_ros.analysis.whole_files import write_whole
    from fpt_ros.bags.reader import read_run
    from fpt_ros.cli.output import console
    from fpt_ros.errors import BadInput
    from fpt_ros.viewers import PROGRAMS
    from fpt_ros.viewers.panels import pages

    if program not in PROGRAMS:
        raise BadInput(f"--for {program}: programs are {', '.join(PROGRAMS)}")
    text, ending = PROGRAMS[program]
    file = out or bag.absolute().with_name(f"{bag.absolute().name}{ending}")
    try:
        write_whole(file, text(pages(read_run(bag))).encode())
    except OSError as error:
        raise BadInput(f"{file} cannot be written: {error.strerror}") from error
    console().print(f"layout: {file}", soft_wrap=True)
