"""``fpt rerun``."""

from pathlib import Path
from typing import Annotated

import typer

from fpt_ros.cli.options import Json, Settings

Bag = Annotated[Path, typer.Argument(metavar="BAG", help="A recording of a run.")]


def rerun(bag: Bag, set_: Settings = None, json: Json = False) -> None:
    """Run a recorded experiment again, from the recording alone, and compare.

    Parameters, seed and changes in flight are those of the recording. A recording in real time is
    replayed node by node, each on what it had seen. Exit status 1 where anything differs, 0 where
    all is equal to the last bit.

    Example: fpt rerun /tmp/tora

    Example: fpt rerun /tmp/tora --set fpt_deformer.A=-0.2
    """
    from fpt_ros.cli import replayed
    from fpt_ros.cli.output import progress_bar
    from fpt_ros.replay.recorded import Recorded
    from fpt_ros.replay.rerun import rerun as run_again

    recorded = Recorded(bag).with_settings(replayed.settings_of(set_ or []))
    with progress_bar(f"rerun {bag}", recorded.total) as progress:
        found = run_again(recorded, progress)
    replayed.show(bag, found, None, json)
    if not all(one.equal for one in found.values()):
        raise typer.Exit(1)
