"""``fpt run``."""

import sys
import tempfile
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Annotated, Any

import typer

from fpt_ros.cli.gain import warn_about_gain
from fpt_ros.cli.interrupts import at_once
from fpt_ros.cli.options import (
    Duration,
    Json,
    Name,
    Record,
    Seed,
    Settings,
    Variant,
    check_new_directory,
    experiment_of,
)

if TYPE_CHECKING:
    from fpt_ros.experiments.experiment import Experiment
    from fpt_ros.nodes.nursery import Nursery
    from fpt_ros.nodes.part import Part
    from fpt_ros.nodes.robot import Robot

Composed = Annotated[bool, typer.Option("--composed", help="The five nodes in one process.")]
Realtime = Annotated[bool, typer.Option("--realtime", help="On the wall clock, not in lockstep.")]
Speed = Annotated[
    float | None,
    typer.Option(metavar="FACTOR", help="Of the wall clock: 0.1 is a tenth of real time."),
]
Split = Annotated[
    str,
    typer.Option(metavar="SIZE|TIME", help="Go on in another file, as after 100MB or 60s."),
]
Namespace = Annotated[str, typer.Option(metavar="NS", help="ROS namespace of all nodes.")]
NoPlant = Annotated[
    bool,
    typer.Option("--no-plant", help="Control a robot instead; until Ctrl-C, or for --duration."),
]
States = Annotated[
    str,
    typer.Option(metavar="TOPIC", help="--no-plant: where the robot tells its joint states."),
]
Efforts = Annotated[
    str,
    typer.Option(metavar="TOPIC", help="--no-plant: where its effort controller listens."),
]
Restarted = Annotated[
    int,
    typer.Option(
        "--restarts", metavar="N", min=0, help="Start a killed node again, N times a minute."
    ),
]
Only = Annotated[
    str,
    typer.Option(metavar="NODE,NODE", help="A part of the graph: other hosts run the rest."),
]


def run(
    name: Name,
    variant: Variant = "adaptive",
    set_: Settings = None,
    duration: Duration = None,
    seed: Seed = None,
    record: Record = None,
    composed: Composed = False,
    realtime: Realtime = False,
    speed: Speed = None,
    namespace: Namespace = "",
    split: Split = "",
    no_plant: NoPlant = False,
    states: States = "joint_states",
    efforts: Efforts = "effort_command",
    restarts: Restarted = 3,
    only: Only = "",
    json: Json = False,
) -> None:
    """Run an experiment as a graph of ROS 2 nodes over DDS, a process each.

    Example: fpt run tora --record /tmp/tora && fpt report /tmp/tora

    A robot: fpt run arm.yaml --no-plant --efforts /effort_controller/commands
    """
    from fpt_ros.bags.split import Split as Parsed
    from fpt_ros.cli.output import print_json, print_result
    from fpt_ros.experiments.description import NODE
    from fpt_ros.nodes.namespace import check
    from fpt_ros.nodes.nursery import Nursery

    with Nursery() as nursery:  # it imports while we read
        with at_once():
            experiment = experiment_of(name, variant, set_, duration, seed)
        if split:
            Parsed.parse(split)
            experiment = experiment.with_values(NODE, split=split)
        if speed is not None:
            realtime = True
            experiment = experiment.with_values("plant_simulator", speed=speed)
            experiment.loop()  # checks it
        check(namespace)
        robot = _robot(no_plant, composed, states, efforts, duration)
        part = _part(only, composed, record)
        if record is not None:
            check_new_directory(record)
        with at_once():
            experiment = warn_about_gain(experiment)
        with tempfile.TemporaryDirectory(prefix="fpt_ros-") as folder:
            bag = record or (Path(folder) / "recording" if part is None else None)
            result, failure = run_recorded(
                nursery, experiment, bag, composed, realtime, namespace, robot, restarts, part
            )
    if result is not None and bag is None:
        print_json(result) if json else print(_told(result))
    elif result is not None:
        print_result({**result, "bag": str(record) if record is not None else None}, json)
    elif json and failure is not None:
        print_json(
            {
                "experiment": experiment.name,
                "variant": experiment.variant,
                "engine": "graph",
                "complete": False,
                "reason": str(failure),
                "bag": str(record) if record is not None else None,
            }
        )
    if failure is not None:
        raise failure


def run_recorded(
    nursery: "Nursery",
    experiment: "Experiment",
    bag: Path | None,
    composed: bool = False,
    realtime: bool = False,
    namespace: str = "",
    robot: "Robot | None" = None,
    restarts: int = 3,
    part: "Part | None" = None,
) -> tuple[dict[str, Any] | None, Exception | None]:
    """Run the graph and read its recording; ``None``: it is recorded on another host, if at all.

    Returns:
        The result so far as the recording goes (None: there is none), and what went wrong.
    """
    from fpt_ros.analysis.recorded import read_summary
    from fpt_ros.cli.output import progress_bar
    from fpt_ros.errors import BadInput, FptError
    from fpt_ros.nodes import graph
    from fpt_ros.nodes.restarts import Restarts

    counted = Restarts(restarts)
    pace: list[tuple[float, int]] = []  # at the first report and at the newest
    failure: FptError | None = None
    total = experiment.loop().plant.cycles
    started = perf_counter()
    with progress_bar(f"{experiment.name} {experiment.variant}", total) as show:

        def progress(done: int) -> None:
            if done:
                pace[1:] = [(perf_counter(), done)]
            show(done)

        try:
            graph.run(
                nursery,
                experiment,
                bag,
                composed,
                realtime,
                namespace,
                progress,
                robot,
                counted,
                tell=lambda line: print(f"fpt: {line}", file=sys.stderr),
                part=part,
            )
        except FptError as error:
            failure = error
    rate = None
    if len(pace) > 1 and pace[-1][0] > pace[0][0]:
        rate = (pace[-1][1] - pace[0][1]) / (pace[-1][0] - pace[0][0])
    seen: dict[str, Any] = {"wall_time": perf_counter() - started, "cycles_per_second": rate}
    seen["restarts"] = counted.total
    if bag is None:
        return None if failure else _of_part(experiment, part, pace, seen), failure
    try:
        return {**read_summary(bag), **seen, "bag": str(bag)}, failure
    except BadInput:
        return None, failure


def _of_part(
    experiment: "Experiment",
    part: "Part | None",
    pace: list[tuple[float, int]],
    seen: dict[str, Any],
) -> dict[str, Any]:
    """What is known of a run that is not recorded here."""
    about = {"experiment": experiment.name, "variant": experiment.variant, "engine": "graph"}
    nodes = list(part.names) if part is not None else []
    cycles = pace[-1][1] if pace else 0
    return {**about, "nodes": nodes, "complete": True, "cycles": cycles, **seen, "bag": None}


def _told(result: dict[str, Any]) -> str:
    name, nodes = f"{result['experiment']} {result['variant']}", ", ".join(result["nodes"])
    return f"{name}, {nodes}: {result['cycles']} cycles in {result['wall_time']:.1f} s"


def _robot(
    no_plant: bool, composed: bool, states: str, efforts: str, duration: float | None
) -> "Robot | None":
    from fpt_ros.errors import BadInput
    from fpt_ros.nodes.robot import EFFORT_COMMAND, Robot

    if no_plant and composed:
        raise BadInput("--no-plant excludes --composed, of which the plant is a part")
    if no_plant:
        return Robot(states, efforts, duration)
    if (states, efforts) != ("joint_states", EFFORT_COMMAND):
        raise BadInput("--states and --efforts are topics of a robot: they go with --no-plant")
    return None


def _part(only: str, composed: bool, record: Path | None) -> "Part | None":
    from fpt_ros.errors import BadInput
    from fpt_ros.nodes.part import Part

    if only and composed:
        raise BadInput("--only excludes --composed, which is all nodes in one process")
    return Part.parse(only, record is not None) if only else None
