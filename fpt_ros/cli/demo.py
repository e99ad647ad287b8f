"""``fpt demo``: the main job in one go."""

from datetime import datetime
from pathlib import Path
from typing import Annotated

import typer

from fpt_ros.cli.options import Duration

Out = Annotated[Path, typer.Option(metavar="DIR", help="A folder is made in here for each demo.")]


def demo(out: Out = Path("demo"), duration: Duration = None) -> None:
    """Run TORA with and without adaptation as processes over DDS, record both, write the report.

    Example: fpt demo --out /tmp/demo
    """
    from fpt_ros.analysis.recorded import read_outline
    from fpt_ros.analysis.report import write_report
    from fpt_ros.analysis.tables import console_table
    from fpt_ros.cli.options import check_new_directory
    from fpt_ros.cli.output import console
    from fpt_ros.cli.run import run_recorded
    from fpt_ros.errors import RunFailed
    from fpt_ros.experiments.experiment import load
    from fpt_ros.nodes.nursery import Nursery

    folder = out / datetime.now().strftime("%Y-%m-%d_%H-%M-%S")
    check_new_directory(folder)
    bags, results = [], []
    with Nursery() as nursery:
        for variant in ("adaptive", "nonadaptive"):
            bag = folder / f"tora_{variant}"
            result, failure = run_recorded(nursery, load("tora", variant, duration=duration), bag)
            if failure is not None or result is None:
                raise failure or RunFailed(f"nothing was recorded in {bag}")
            bags.append(bag)
            results.append(result)
    page = write_report([read_outline(bag) for bag in bags], folder / "report")
    screen = console()
    screen.print(console_table(results))
    for bag in bags:
        screen.print(f"recording: {bag}", soft_wrap=True)
    screen.print(f"report:    {page}", soft_wrap=True)
