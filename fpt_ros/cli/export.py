"""``fpt export``."""

from pathlib import Path
from typing import Annotated

import typer

from fpt_ros.cli.options import Json

Bag = Annotated[Path, typer.Argument(metavar="BAG", help="A recording, whoever made it.")]
Format = Annotated[
    str, typer.Option("--format", metavar="csv|parquet|mat|npz|mcap", help="Of the file to write.")
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
    mcap is for PlotJuggler and Foxglove: the recording in one file, with its trajectories once more
    as JointState (/desired/flat), which viewers plot by the names of the joints.

    Example: fpt export /tmp/tora --format mat --topic /joint_states
    """
    from fpt_ros.bags.export import FLAT, target
    from fpt_ros.cli.output import console, print_json
    from fpt_ros.cli.recordings import say
    from fpt_ros.errors import BadInput

    chosen = target(bag, format, out)
    write = _viewers if format == FLAT else _tables
    try:
        topics, missing, left_out = write(bag, format, tuple(topic or ()), chosen)
    except OSError as error:
        raise BadInput(f"{chosen} cannot be written: {error.strerror}") from error
    if json:
        print_json(
            {
                "bag": str(bag),
                "out": str(chosen),
                "topics": topics,
                "missing": list(missing),
                "left_out": left_out,
            }
        )
        return
    say(bag, (*missing, *left_out.values()))
    count = f"{sum(topics.values())} messages of {len(topics)} topics"
    console().print(f"{count}: {chosen}", soft_wrap=True)


Written = tuple[dict[str, int], tuple[str, ...], dict[str, str]]
"""Messages by topic; what is missing; topics that are left out, and why."""


def _tables(bag: Path, format: str, topics: tuple[str, ...], file: Path) -> Written:
    from fpt_ros.analysis.whole_files import write_whole
    from fpt_ros.bags.export import FORMATS
    from fpt_ros.bags.tables import read_tables
    from fpt_ros.errors import BadInput

    tables = read_tables(bag, topics)
    if not any(len(table) for table in tables.tables.values()):
        why = "; ".join((*tables.missing, *tables.left_out.values())) or "it has no messages"
        raise BadInput(f"{bag} holds nothing to export: {why}")
    write_whole(file, FORMATS[format](tables))
    counts = {name: len(table) for name, table in tables.tables.items()}
    return counts, tables.missing, dict(tables.left_out)


def _viewers(bag: Path, format: str, topics: tuple[str, ...], file: Path) -> Written:
    from fpt_ros.bags.flat import write_flat

    return *write_flat(bag, file, topics), {}
