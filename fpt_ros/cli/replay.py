"""``fpt replay``."""

from pathlib import Path
from typing import Annotated

import typer

from fpt_ros.cli.options import Json, Record

Bag = Annotated[Path, typer.Argument(metavar="BAG", help="A recording of a run.")]
Node = Annotated[str, typer.Option(metavar="NODE", help="Of the loop: which one is run again.")]
Settings = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="PARAM=VALUE", help="Change a parameter of it; repeatable."),
]
Live = Annotated[
    bool, typer.Option("--live", help="Over DDS, into a node that is running, instead of here.")
]
Rate = Annotated[
    float | None,
    typer.Option(metavar="R", help="With --live: by the clock, R times as fast as recorded."),
]


def replay(
    bag: Bag,
    node: Node,
    set_: Settings = None,
    record: Record = None,
    live: Live = False,
    rate: Rate = None,
    json: Json = False,
) -> None:
    """Run one node of a recorded run again, on the inputs that it had, and compare its answers.

    With the parameters of the recording, and its changes in flight, the answers are the same to the
    last bit. With --live the inputs go over DDS to a node that is running already: cycle by cycle
    as it answers, or with --rate by the clock. Exit status 1 where an answer differs, 0 where all
    are equal.

    Example: fpt replay /tmp/tora --node fpt_deformer

    Example: fpt replay /tmp/tora --node fpt_deformer --set A=-0.2 --record /tmp/stronger

    Example: fpt replay /tmp/tora --node denoiser --live --rate 1
    """
    from contextlib import ExitStack

    from fpt_ros.cli import replayed
    from fpt_ros.cli.options import check_new_directory
    from fpt_ros.cli.output import progress_bar
    from fpt_ros.errors import BadInput
    from fpt_ros.replay.recorded import Recorded
    from fpt_ros.replay.replayed import Replay
    from fpt_ros.replay.writing import ReplayWriter

    if rate is not None and not live:
        raise BadInput("--rate is for --live: in process a replay is as fast as it can be")
    if live and set_:
        raise BadInput("--set is for a replay in process: a running node has its own parameters")
    if record is not None:
        check_new_directory(record)
    settings = replayed.settings_of(set_ or [], node)
    prepared = Replay(Recorded(bag).with_settings(settings), node)
    with ExitStack() as stack:
        out = None
        if record is not None:
            out = stack.enter_context(ReplayWriter(record, prepared))
        progress = stack.enter_context(progress_bar(f"replay {node}", prepared.recorded.total))
        if live:
            from fpt_ros.nodes.replay import run_live

            found = run_live(prepared, rate, progress, out)
        else:
            found = prepared.run(progress, out)
    replayed.show(bag, {node: found}, record, json)
    if not found.equal:
        raise typer.Exit(1)
