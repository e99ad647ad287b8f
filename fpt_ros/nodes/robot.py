"""A robot in the place of the plant's node: what the graph is told then."""

from dataclasses import dataclass

from fpt_ros.cycle.denoiser import Denoiser
from fpt_ros.cycle.fpt_deformer import FptDeformer
from fpt_ros.cycle.stage import ROBOT
from fpt_ros.experiments.description import NODE as RECORDER
from fpt_ros.experiments.experiment import Experiment
from fpt_ros.messages.topics import JOINT_STATES

EFFORT_COMMAND = "effort_command"
"""Topic of the bare efforts, std_msgs/Float64MultiArray."""


@dataclass(frozen=True)
class Robot:
    """A plant that somebody else runs.

    Attributes:
        states: topic on which it tells its joint states.
        efforts: topic on which it takes efforts, as std_msgs/Float64MultiArray.
        lasts: how long it is controlled [s]; None: until Ctrl-C.
    """

    states: str = JOINT_STATES.name
    efforts: str = EFFORT_COMMAND
    lasts: float | None = None

    def experiment(self, experiment: Experiment) -> Experiment:
        """The same experiment, its nodes told that there is a robot, which takes bare efforts."""
        experiment = experiment.with_values(FptDeformer.name, effort_command=True)
        for node in (Denoiser.name, FptDeformer.name, RECORDER):
            experiment = experiment.with_values(node, **{ROBOT.name: True})
        return experiment

    def remappings(self) -> list[str]:
        """ROS arguments of all nodes."""
        pairs = ((JOINT_STATES.name, self.states), (EFFORT_COMMAND, self.efforts))
        return [word for old, new in pairs if old != new for word in ("-r", f"{old}:={new}")]
