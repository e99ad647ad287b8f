"""``fpt info``."""

from pathlib import Path
from typing import Annotated, Any

import typer

from fpt_ros.cli.options import Json

Bag = Annotated[Path, typer.Argument(metavar="BAG", help="A recording, whoever made it.")]


Parameters = Annotated[
    bool,
    typer.Option("--parameters", help="Print the ROS parameter file of all nodes, nothing else."),
]


def info(bag: Bag, json: Json = False, parameters: Parameters = False) -> None:
    """What a recording holds: experiment, topics, parameters, and whether it is complete.

    Example: fpt info demo/adaptive

    Example: fpt info demo/adaptive --parameters > tora.yaml
    """
    from fpt_ros.bags import parameter_text, reader
    from fpt_ros.cli.output import console, print_json
    from fpt_ros.errors import BadInput
    from fpt_ros.runs.cost import HEADINGS, row

    content: dict[str, Any] = dict(reader.info(bag))
    if parameters:
        if not content["parameters"]:
            raise BadInput(f"{bag} holds no parameters: it is not a recording of this package")
        print(parameter_text.to_text(content["parameters"]), end="")
        return
    if json:
        print_json(content)
        return
    from rich.table import Table
    from rich.text import Text

    out = console()
    nodes, topics = content.pop("parameters"), content.pop("topics")
    costs = content.pop("costs")
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
    if costs:
        taken = Table(box=None, pad_edge=False)
        taken.add_column(HEADINGS[0], overflow="fold")
        for heading in HEADINGS[1:]:
            taken.add_column(Text(heading), justify="right")
        for cost in costs:
            taken.add_row(*row(cost))
        out.print(taken)
    for node, values in nodes.items():
        words = ", ".join(f"{name}={value}" for name, value in values.items())
        out.print(Text(f"{node}: {words}"), soft_wrap=True)
