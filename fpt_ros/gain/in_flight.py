"""What can be said of a gain A while the loop runs, by a node that does not know the plant.

What it was told at the start (``gain_scale``) holds for the plant that the parameter files
simulate, along the nominal motion. The transformation's own parameters are the node's: their slope
is worked out anew. Where anything else that the range follows from has changed, nothing is said.
"""

from fpt_ros.cycle.deformer_parameters import GAIN_SCALE
from fpt_ros.cycle.fpt_deformer import FptDeformer
from fpt_ros.gain.interval import holds, interval, linear_limit, sign_of
from fpt_ros.parameters import number

UNTOLD = "the nodes were not told what it follows from: fpt run tells it, or gain_scale"


class GainInFlight:
    """Judges the gain of a deformer.

    Attributes:
        unknown: why nothing can be said of any A; empty: it can.
    """

    def __init__(self, stage: FptDeformer) -> None:
        self.unknown = "" if number(stage.values, GAIN_SCALE.name) else UNTOLD
        self._adapts = stage.transformation.adapts
        self._own = {each.name for each in stage.transformation.parameters}
        self._model = {"weights"}
        self._model |= {name for name in stage.values if name.startswith("approximate.")}

    def concerns(self, names: set[str]) -> bool:
        """Whether a change of these parameters of the deformer is one of its gain's."""
        return self._adapts and bool(names & self._own)

    def forget(self, node: str, names: set[str]) -> None:
        """Parameters of a node have changed from which the range follows, or do not matter."""
        if node == FptDeformer.name:
            names = names & self._model
        elif node == "plant_simulator":
            names = {name for name in names if name.startswith("exact.")}
        elif node != "trajectory_generator":
            return
        if names and not self.unknown:
            self.unknown = f"{node}.{min(names)} has changed since the start"

    def judge(self, stage: FptDeformer) -> str:
        """What is to be said, in one line, of the A of a stage; empty: it contracts."""
        constants = stage.transformation.prepare(stage.values)
        slope, scale = stage.transformation.slope(constants), number(stage.values, GAIN_SCALE.name)
        A = f"fpt_deformer.A = {constants[0]:g}"
        if self.unknown or not slope:
            return f"whether the iteration contracts with {A} is not known here, {self.unknown}"
        within = interval(sign_of(slope, scale), linear_limit(slope, abs(scale)))
        if holds(constants[0], within):
            return ""
        low, high = within
        return f"{A} is outside the range ({low:.4g}, {high:.4g}) in which the iteration contracts"
