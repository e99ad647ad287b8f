"""Console script ``fpt_deformer``."""

from std_msgs.msg import Float64MultiArray

from fpt_ros.cycle.fpt_deformer import FptDeformer
from fpt_ros.messages.frames import Command, Frame
from fpt_ros.nodes.process import run_process
from fpt_ros.nodes.stage_node import StageNode

EFFORT_COMMAND = "effort_command"


class DeformerNode(StageNode):
    """The deformer; on request its efforts also go to a ros2_control effort controller."""

    def __init__(self) -> None:
        super().__init__(FptDeformer)
        self._efforts = self.create_publisher(Float64MultiArray, EFFORT_COMMAND, 1)

    def send(self, frame: Frame) -> None:
        """Publish the command, and the bare efforts where ``effort_command`` is set."""
        super().send(frame)
        if self.stage.values["effort_command"] and isinstance(frame, Command):
            self._efforts.publish(Float64MultiArray(data=list(frame.effort)))


def main() -> None:
    """Run the node until it is told to stop."""
    run_process([DeformerNode], FptDeformer.name, FptDeformer.__doc__ or "")


if __name__ == "__main__":
    main()
