"""``fpt doctor``."""

from typing import Annotated

import typer

from fpt_ros.cli.options import Json

Fix = Annotated[bool, typer.Option("--fix", help="Remove leftovers that nobody uses.")]


def doctor(fix: Fix = False, json: Json = False) -> None:
    """Look whether this machine is fit for a graph of nodes, and say what to do.

    Exit status: 0 nothing is wrong (there may be warnings), 1 something is.

    Example: fpt doctor --fix
    """
    from fpt_ros.cli.output import print_json
    from fpt_ros.nodes import doctor as looking
    from fpt_ros.nodes import shared_memory

    removed = shared_memory.remove(shared_memory.leftovers()) if fix else 0
    found = list(looking.findings())
    if json:
        print_json({"removed": removed, "findings": [each._asdict() for each in found]})
    else:
        if fix:
            print(f"{removed} leftovers removed")
        for each in found:
            remedy = f" -> {each.remedy}" if each.remedy else ""
            print(f"{each.state:8} {each.what:12} {each.text}{remedy}")
    if any(each.state == looking.WRONG for each in found):
        raise typer.Exit(1)
