"""``fpt diff``."""

from pathlib import Path
from typing import Annotated

import typer

from fpt_ros.cli.options import Json

One = Annotated[Path, typer.Argument(metavar="BAG", help="A recording.")]
Other = Annotated[Path, typer.Argument(metavar="BAG", help="The one to compare it with.")]
Topics = Annotated[
    list[str] | None, typer.Option("--topic", metavar="T", help="Only this one; repeatable.")
]


def diff(one: One, other: Other, topic: Topics = None, json: Json = False) -> None:
    """What differs between two recordings: the first place, then how much, by topic and field.

    Exit status 1 where they differ, 0 where all numbers are the same to the last bit.

    Example: fpt diff /tmp/tora /tmp/tora-again
    """
    from dataclasses import asdict
    from math import isfinite

    from fpt_ros.bags.difference import compare
    from fpt_ros.bags.tables import read_tables
    from fpt_ros.cli.output import console, print_json
    from fpt_ros.cli.recordings import say

    both = [read_tables(bag, tuple(topic or ())) for bag in (one, other)]
    found = compare(*both)
    if json:
        fields = [
            {k: v if not isinstance(v, float) or isfinite(v) else None for k, v in each.items()}
            for each in map(asdict, found.fields)
        ]
        print_json(
            {
                "equal": found.equal,
                "first_difference": asdict(found.first) if found.first is not None else None,
                "fields": fields,
                "counts": found.counts,
                "only": {topic: str((one, other)[at - 1]) for topic, at in found.only.items()},
            }
        )
    else:
        for bag, tables in zip((one, other), both, strict=True):
            say(bag, tables.missing)
        out = console()
        if found.equal:
            out.print("equal to the last bit")
            return
        for name, at in found.only.items():
            out.print(f"{name}: only in {(one, other)[at - 1]}", soft_wrap=True)
        for name, (first, second) in found.counts.items():
            out.print(f"{name}: {first} messages, and {second}")
        if found.first is not None:
            first_ = found.first
            out.print(
                f"first difference: {first_.topic} {first_.name}, message {first_.row} at "
                f"{first_.time:.9g} s: {first_.values[0]!r}, and {first_.values[1]!r}",
                soft_wrap=True,
            )
            from rich.table import Table

            table = Table("topic", "field", "differ", "largest", "rms", "unit", box=None)
            for each in found.fields:
                table.add_row(
                    each.topic,
                    each.name,
                    str(each.count),
                    f"{each.largest:.4g}",
                    f"{each.rms:.4g}",
                    each.unit,
                )
            out.print(table)
    if not found.equal:
        raise typer.Exit(1)
