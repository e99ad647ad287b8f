"""``fpt export``."""

from pathlib import Path
from typing import Annotated

import typer

from fpt_ros.cli.options import Json

Bag = Annotated[Path, typer.Argument(metavar="BAG", help="A recording, whoever made it.")]
Format = Annotated[
    str, typer.Option("--format", metavar="csv|parquet|mat|npz", help="Of the file to write.")
]
Topics = Annotated[
    list[str] | None, typer.Option("--topic", metavar="T", help="Only this one; repeatable.")
]
Out = Annotated[
    Path | None, typer.Option(metavar="FILE", help="Where to write; default: BAG.FORMAT.")
]


def export(
    bag: Bag,
    format: Format = "csv",
    topic: Topics = None,
    out: Out = None,
    json: Json = False,
) -> None:
    """Write the numbers of a recording for other programs, with their names and units.

    csv and parquet hold one table on one time axis, mat a structure a topic, npz an array a number.

    Example: fpt export /tmp/tora --format mat --topic /joint_states
    """
    from fpt_ros.analysis.whole_files import write_whole
    from fpt_ros.bags.export import FORMATS, target
    from fpt_ros.bags.tables import read_tables
    from fpt_ros.cli.output import console, print_json
    from fpt_ros.cli.recordings import say
    from fpt_ros.errors import BadInput

    chosen = target(bag, format, out)
    tables = read_tables(bag, tuple(topic or ()))
    if not any(len(table) for table in tables.tables.values()):
        why = "; ".join((*tables.missing, *tables.left_out.values())) or "it has no messages"
        raise BadInput(f"{bag} holds nothing to export: {why}")
    try:
        write_whole(chosen, FORMATS[format](tables))
    except OSError as error:
        raise BadInput(f"{chosen} cannot be written: {error.strerror}") from error
    if json:
        print_json(
            {
                "bag": str(bag),
                "out": str(chosen),
                "topics": {name: len(table) for name, table in tables.tables.items()},
                "missing": list(tables.missing),
                "left_out": dict(tables.left_out),
            }
        )
        return
    say(bag, (*tables.missing, *tables.left_out.values()))
    rows = sum(map(len, tables.tables.values()))
    console().print(f"{rows} messages of {len(tables.tables)} topics: {chosen}", soft_wrap=True)
