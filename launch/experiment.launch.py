"""An experiment as a graph of nodes: ros2 launch fpt_ros experiment.launch.py experiment:=tora."""

import shutil
import tempfile
from pathlib import Path

from launch.actions import DeclareLaunchArgument, OpaqueFunction, RegisterEventHandler, Shutdown
from launch.event_handlers import OnProcessExit, OnShutdown
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

from fpt_ros.cycle.stages import STAGES
from fpt_ros.experiments.experiment import load
from fpt_ros.gain.warning import known, told
from fpt_ros.nodes.part import Part
from launch import LaunchDescription


def ended(event, context):
    """The run is over when the plant has finished; any other end is a failure of the launch."""
    if context.is_shutdown:
        return None
    if event.returncode:
        raise RuntimeError(f"{event.action.name} ended with status {event.returncode}")
    return [Shutdown(reason=f"{event.action.name} ended")]


def ended_with_plant(event, context):
    """The plant is on another host: each node ends by itself when that one says so."""
    if event.returncode and not context.is_shutdown:
        raise RuntimeError(f"{event.action.name} ended with status {event.returncode}")


def start(context):
    experiment_name, variant, record, namespace, only = (
        LaunchConfiguration(name).perform(context)
        for name in ("experiment", "variant", "record", "namespace", "only")
    )
    experiment = load(experiment_name, variant)
    experiment = told(experiment, known(experiment)).for_graph(realtime=False)
    names = list(STAGES)
    on_exit = ended
    if only:
        part = Part.parse(only, bool(record))
        experiment, names = part.experiment(experiment), list(part.names)
        on_exit = ended if part.has_plant else ended_with_plant
    if record:
        experiment = experiment.with_values("plant_simulator", await_recorder=True)
        cycles = experiment.loop().plant.cycles
        experiment = experiment.with_values("recorder", directory=record, cycles=cycles)
        names.append("recorder")
    folder = Path(tempfile.mkdtemp(prefix="fpt_ros-"))
    parameters = folder / "parameters.yaml"
    experiment.write(parameters)
    nodes = [
        Node(
            package="fpt_ros",
            executable=name,
            name=name,
            namespace=namespace,
            parameters=[str(parameters)],
            output="screen",
        )
        for name in names
    ]

    def clean_up(event, context):
        shutil.rmtree(folder, ignore_errors=True)

    # first the handlers: a node may end at once
    return [
        RegisterEventHandler(OnShutdown(on_shutdown=clean_up)),
        *(
            RegisterEventHandler(OnProcessExit(target_action=node, on_exit=on_exit))
            for node in nodes
        ),
        *nodes,
    ]


def generate_launch_description():
    return LaunchDescription(
        [
            DeclareLaunchArgument("experiment", default_value="tora", description="fpt list"),
            DeclareLaunchArgument("variant", default_value="adaptive", description="fpt list"),
            DeclareLaunchArgument(
                "record", default_value="", description="directory of the recording; empty: none"
            ),
            DeclareLaunchArgument("namespace", default_value="", description="of all nodes"),
            DeclareLaunchArgument(
                "only", default_value="", description="NODE,NODE: other hosts run the rest"
            ),
            OpaqueFunction(function=start),
        ]
    )
