"""Console script ``trajectory_generator``: the stage's node, which may follow a live topic."""

from fpt_ros.cycle.trajectory_generator import TrajectoryGenerator
from fpt_ros.nodes.process import run_process
from fpt_ros.nodes.stage_node import StageNode
from fpt_ros.trajectories.live import LIVE


class TrajectoryNode(StageNode):
    """The trajectory generator; with ``trajectory: live`` it listens to a motion."""

    def __init__(self, reports: bool = True) -> None:
        """``reports``: as of any stage's node."""
        super().__init__(TrajectoryGenerator, reports)
        self._motion = None
        if self.stage.trajectory is LIVE:
            from fpt_ros.nodes.live_motion import LiveMotion

            self._motion = LiveMotion(self)

    def housekeeping(self) -> None:
        """Also whether the motion is silent."""
        super().housekeeping()
        if self._motion is not None:
            self._motion.look_whether_silent()

    def health(self) -> tuple[str, dict[str, object]]:
        """Also of the motion."""
        summary, values = super().health()
        return summary, {**values, **(self._motion.report() if self._motion else {})}


def main() -> None:
    """Run the node until it is told to stop."""
    run_process([TrajectoryNode], TrajectoryGenerator.name, TrajectoryGenerator.__doc__ or "")


if __name__ == "__main__":
    main()
