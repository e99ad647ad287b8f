"""A part of the graph: the nodes that one of several hosts runs."""

from dataclasses import dataclass

from fpt_ros.cycle.plant_simulator import PlantSimulator
from fpt_ros.cycle.stage import ENDS_WITH_PLANT
from fpt_ros.cycle.stages import STAGES
from fpt_ros.errors import BadInput
from fpt_ros.experiments.description import NODE as RECORDER
from fpt_ros.experiments.experiment import Experiment


@dataclass(frozen=True)
class Part:
    """Some nodes of the graph.

    Attributes:
        names: of the loop's nodes, in the order of events; none where the recorder is alone.
    """

    names: tuple[str, ...]

    @classmethod
    def parse(cls, text: str, recorded: bool) -> "Part":
        """From ``NODE,NODE``; ``recorded``: whether there is a recorder, as any host may have it.

        Raises:
            BadInput: there is no such node, or none at all.
        """
        asked = [name.strip() for name in text.split(",")]
        for name in asked:
            if name not in (*STAGES, RECORDER):
                there = ", ".join((*STAGES, RECORDER))
                raise BadInput(f"--only: there is no node '{name}', only {there}")
        if RECORDER in asked and not recorded:
            raise BadInput("--only recorder: it takes --record DIR as well")
        return cls(tuple(name for name in STAGES if name in asked))

    @property
    def has_plant(self) -> bool:
        """Whether the plant's node is here, with which the run ends."""
        return PlantSimulator.name in self.names

    def experiment(self, experiment: Experiment) -> Experiment:
        """The same experiment, its nodes told that the plant's is on another host."""
        if self.has_plant:
            return experiment
        for node in (*STAGES, RECORDER):
            if node != PlantSimulator.name:
                experiment = experiment.with_values(node, **{ENDS_WITH_PLANT.name: True})
        return experiment
