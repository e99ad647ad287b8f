"""``fpt recover``."""

from pathlib import Path
from typing import Annotated

import typer

from fpt_ros.cli.options import Json

Bag = Annotated[Path, typer.Argument(metavar="BAG", help="A recording, or one file of it.")]
Out = Annotated[
    Path | None,
    typer.Option(metavar="DIR", help="Where to write; default: BAG-recovered beside BAG."),
]


def recover(bag: Bag, out: Out = None, json: Json = False) -> None:
    """Write all that is whole in a damaged recording as a new one that every reader opens.

    For recordings that were cut, killed, or are without index or metadata.yaml; whoever made them.
    The old recording stays as it is.

    Example: fpt recover /tmp/tora --out /tmp/tora-recovered
    """
    from fpt_ros.bags.recover import recover as write
    from fpt_ros.cli.output import console, print_json
    from fpt_ros.cli.recordings import say

    done = write(bag, out)
    if json:
        print_json(
            {
                "bag": str(bag),
                "recovered": str(done.directory),
                "messages": sum(done.counts.values()),
                "topics": dict(done.counts),
                "missing": list(done.missing),
            }
        )
        return
    say(bag, done.missing)
    total = sum(done.counts.values())
    console().print(f"{total} messages written: {done.directory}", soft_wrap=True)
