"""``fpt info``."""

from pathlib import Path
from typing import Annotated, Any

import typer

from fpt_ros.cli.options import Json

Bag = Annotated[Path, typer.Argument(metavar="BAG", help="A recording, whoever made it.")]


def info(bag: Bag, json: Json = False) -> None:
    """What a recording holds: experiment, topics, parameters, and whether it is complete.

    Example: fpt info demo/adaptive
    """
    from fpt_ros.bags import reader
    from fpt_ros.cli.output import console, print_json

    content: dict[str, Any] = dict(reader.info(bag))
    if json:
        print_json(content)
        return
    from rich.table import Table
    from rich.text import Text

    out = console()
    parameters, topics = content.pop("parameters"), content.pop("topics")
    lines = {"missing": content.pop("missing"), "note": content.pop("notes")}
    table = Table(box=None, show_header=False, pad_edge=False)
    for key, value in content.items():
        table.add_row(key, Text(str(value)))
    for key, found in lines.items():
        for line in found:
            table.add_row(key, Text(line))
    out.print(table)
    counts = Table("topic", "type", "messages", box=None, pad_edge=False)
    for topic, each in topics.items():
        counts.add_row(topic, each["type"], str(each["messages"]))
    out.print(counts)
    for node, values in parameters.items():
        words = ", ".join(f"{name}={value}" for name, value in values.items())
        out.print(Text(f"{node}: {words}"), soft_wrap=True)
