"""An experiment as a graph of nodes: ros2 launch fpt_ros experiment.launch.py experiment:=tora."""

import tempfile
from pathlib import Path

from launch.actions import DeclareLaunchArgument, OpaqueFunction, RegisterEventHandler, Shutdown
from launch.event_handlers import OnProcessExit
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

from fpt_ros.loop.experiment import load
from fpt_ros.loop.stages import STAGES
from launch import LaunchDescription


def start(context):
    experiment_name, variant, record, namespace = (
        LaunchConfiguration(name).perform(context)
        for name in ("experiment", "variant", "record", "namespace")
    )
    experiment = load(experiment_name, variant)
    names = list(STAGES)
    if record:
        experiment = experiment.with_values("plant_simulator", await_recorder=True)
        cycles = experiment.loop().plant.cycles
        experiment = experiment.with_values("recorder", directory=record, cycles=cycles)
        names.append("recorder")
    parameters = Path(tempfile.mkdtemp(prefix="fpt_ros-")) / "parameters.yaml"
    experiment.write(parameters)
    nodes = {
        name: Node(
            package="fpt_ros",
            executable=name,
            name=name,
            namespace=namespace,
            parameters=[str(parameters)],
            output="screen",
        )
        for name in names
    }
    finished = OnProcessExit(
        target_action=nodes["plant_simulator"], on_exit=[Shutdown(reason="the run is over")]
    )
    return [*nodes.values(), RegisterEventHandler(finished)]


def generate_launch_description():
    return LaunchDescription(
        [
            DeclareLaunchArgument("experiment", default_value="tora", description="fpt list"),
            DeclareLaunchArgument("variant", default_value="adaptive", description="fpt list"),
            DeclareLaunchArgument(
                "record", default_value="", description="directory of the recording; empty: none"
            ),
            DeclareLaunchArgument("namespace", default_value="", description="of all nodes"),
            OpaqueFunction(function=start),
        ]
    )
