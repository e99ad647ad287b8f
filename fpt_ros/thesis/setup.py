"""A run of an experiment that a claim needs."""

import shlex
from collections.abc import Mapping
from dataclasses import dataclass

from fpt_ros.errors import RunFailed
from fpt_ros.experiments.experiment import BASE, Experiment, load
from fpt_ros.runs.run import Run, describe

Runs = Mapping[str, Run]
"""The runs of a claim, by the keys under which it asks for them."""

HEAVY = {"cart_beam_hamper": 6.0, "swing": 8.0, "kapitza": 3.0, "spherical_pendulum": 3.0}
"""Experiments that take longer than a short one, and how many times."""


@dataclass(frozen=True)
class Setup:
    """A run that a claim needs: what ``fpt simulate`` is given."""

    name: str
    variant: str = BASE
    settings: tuple[str, ...] = ()
    duration: float | None = None

    def experiment(self) -> Experiment:
        """Its parameters, complete and checked."""
        return load(self.name, self.variant, self.settings, self.duration)

    @property
    def effort(self) -> float:
        """1 for a short run."""
        return HEAVY.get(self.name, 1.0)

    def perform(self, key: str) -> Run:
        """The run, in process; one that diverges ends where it does."""
        from fpt_ros.engine.engine import Engine

        experiment = self.experiment()
        engine = Engine(experiment.loop())
        reason = ""
        try:
            engine.run()
        except RunFailed as error:
            reason = str(error)
        info = {**describe(experiment, "in_process", reason), "variant": key}
        return Run(info, experiment.nodes, engine.topics())

    def ending(self, result: Run) -> str:
        """Why the run did not come to its end."""
        return str(result.info["reason"])

    def command(self) -> str:
        """The line for a shell that makes this run."""
        words = ["fpt", "simulate", self.name]
        if self.variant != BASE:
            words += ["--variant", self.variant]
        for setting in self.settings:
            words += ["--set", setting]
        if self.duration is not None:
            words += ["--duration", f"{self.duration:g}"]
        return shlex.join(words)
