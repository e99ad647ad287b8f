"""The runs that are compared: all variants of a tree, and some settings that no variant has."""

from dataclasses import dataclass
from fnmatch import fnmatchcase
from pathlib import Path

CYCLES = 600
"""Length of a run, where nothing else is said."""

LONG = {"tora": 16.0, "vdp_rfpt": 16.0, "noisy_tora": 16.0}
"""Base variants that run for a time [s], in which learning and filters settle."""

SWING = ("trajectory_generator.time_sharing=[0.01, 0.0055]",)
NOISE = ("plant_simulator.noise.position=1e-4", "plant_simulator.noise.velocity=1e-3")

ALWAYS = {"swing": SWING, "swing.nonadaptive": SWING}
"""Settings that make a short run pass through all that a long one does."""

EXTRA: dict[str, tuple[str, ...]] = {
    "tora.strong+substeps": ("plant_simulator.substeps=7",),
    "tora+noise": NOISE,
    "tora+weights": ("fpt_deformer.weights=[0.5, 2.0]",),
    "tora+signed": ("fpt_deformer.form=signed",),
    "tora+diverges": ("fpt_deformer.A=0.1",),
    "tora_auto+guard": ("parameter_tuner.precursor_guard=true",),
    "spherical_pendulum+hold": ("fpt_deformer.learning_delay=1", "fpt_deformer.learning_hold=10"),
    "spherical_pendulum.fixed_weights+noise": NOISE,
    "mimo_affine+initial": ("fpt_deformer.initial_response=[1.0, -1.0]",),
}
"""Paths that no variant takes: VARIANT+LABEL -> settings."""


@dataclass(frozen=True)
class Case:
    """One run.

    Attributes:
        name: ``tora``, ``tora.strong``, or ``tora+noise`` for settings of ours.
        experiment, variant, settings: as ``experiment.load`` takes them.
        cycles: its length; None: as long as its file says.
        seconds: its least length [s].
    """

    name: str
    experiment: str
    variant: str
    settings: tuple[str, ...]
    cycles: int | None
    seconds: float

    @property
    def file(self) -> str:
        """Name of the file that keeps it, another one for another length."""
        length = "full" if self.cycles is None else f"{self.cycles}_{self.seconds:g}s"
        return f"{self.name}-{length}.npz"


def cases(config: Path, cycles: int | None, patterns: list[str]) -> list[Case]:
    """All cases of a tree with this config folder whose names match one of the patterns.

    Raises:
        ValueError: a pattern matches none.
    """
    stems = [path.stem for path in sorted(config.glob("*.yaml"))]
    extra = [name for name in EXTRA if name.partition("+")[0] in stems]
    for pattern in patterns:
        if not any(fnmatchcase(name, pattern) for name in (*stems, *extra)):
            raise ValueError(f"no variant '{pattern}': there are {', '.join((*stems, *extra))}")
    found = []
    for name in (*stems, *extra):
        if any(fnmatchcase(name, pattern) for pattern in patterns):
            stem = name.partition("+")[0]
            experiment, _, variant = stem.partition(".")
            settings = (*ALWAYS.get(stem, ()), *EXTRA.get(name, ()))
            seconds = LONG.get(name, 0.0)
            found.append(Case(name, experiment, variant or "adaptive", settings, cycles, seconds))
    return found
