"""What follows from the parameters that are given: said once, and known to every node."""

from collections.abc import Iterable
from typing import cast

from fpt_ros.cycle.denoiser import FILTER_OF_NOISE, METHOD, SYNCHRONISED, Denoiser
from fpt_ros.cycle.fpt_deformer import FptDeformer
from fpt_ros.cycle.healing import HEALING, HEALING_OF_LOSSES
from fpt_ros.cycle.plant_simulator import PlantSimulator
from fpt_ros.cycle.stage import CYCLE_TIME, JOINTS
from fpt_ros.cycle.stages import Loop
from fpt_ros.cycle.suffered import SENSORS
from fpt_ros.cycle.trajectory_generator import TrajectoryGenerator
from fpt_ros.cycle.tuned import CONTROLLED
from fpt_ros.errors import BadInput
from fpt_ros.experiments.parameter_file import ParameterFile
from fpt_ros.experiments.response_map import mean_diagonal
from fpt_ros.experiments.sections import SECTIONS, declared_by
from fpt_ros.parameters import Value, Values, word
from fpt_ros.plants import PLANTS, made

OWN_CONTROLLED = (TrajectoryGenerator.name, CONTROLLED.name)
"""Where it is said which coordinates are controlled; other nodes are told."""

AUTO = "auto"
"""In the place of the deformer's weights: they follow from the response map."""


def share_synchronised(file: ParameterFile) -> None:
    """What the deformer is told, or all nodes, holds for deformer and denoiser alike."""
    name = SYNCHRONISED.name
    given = file.nodes[FptDeformer.name].get(name, file.shared.get(name))
    for node in (FptDeformer.name, Denoiser.name):
        file.nodes[node].pop(name, None)
    if given is not None:
        file.shared[name] = given


def derive_names(
    file: ParameterFile, plant: Values, changes: Iterable[tuple[str, str, object]]
) -> None:
    """What all nodes know of the plant and of the motion: joints, cycle time, controlled."""
    controlled = file.nodes[TrajectoryGenerator.name].get(CONTROLLED.name)
    derived: dict[str, object] = {
        JOINTS.name: list(made(PLANTS[word(plant, "plant")], plant, "exact").coordinates),
        CYCLE_TIME.name: plant["dt"],
        CONTROLLED.name: controlled if controlled is not None else [],
    }
    for node, parameter, value in changes:
        if (node, parameter) == OWN_CONTROLLED or parameter not in derived:
            continue
        if value != derived[parameter]:
            raise BadInput(f"{node}.{parameter} follows from plant and trajectory: leave it out")
    for name in derived:
        file.shared.pop(name, None)
    for node, parameters in SECTIONS.items():
        values = file.nodes[node]
        for name in declared_by(parameters, {**file.shared, **values}) & derived.keys():
            if (node, name) != OWN_CONTROLLED:
                values[name] = cast(Value, derived[name])


def heal_losses(file: ParameterFile) -> None:
    """Samples that disturbed sensors lose are healed where nobody has chosen how."""
    plant = {**file.shared, **file.nodes[PlantSimulator.name]}
    if plant.get(SENSORS.name) and HEALING.name not in {
        **file.shared,
        **file.nodes[Denoiser.name],
    }:
        file.nodes[Denoiser.name][HEALING.name] = HEALING_OF_LOSSES


def filter_noise(file: ParameterFile) -> None:
    """Noisy measurements are filtered where nobody has chosen how."""
    plant = {**file.shared, **file.nodes[PlantSimulator.name]}
    noisy = any(plant.get(f"noise.{kind}") for kind in ("position", "velocity"))
    if noisy and METHOD.name not in {**file.shared, **file.nodes[Denoiser.name]}:
        file.nodes[Denoiser.name][METHOD.name] = FILTER_OF_NOISE


def asks_for_weights(file: ParameterFile) -> bool:
    """Whether the weights are to be worked out; the word is taken out of the file.

    Raises:
        BadInput: another word stands there.
    """
    nodes = file.nodes[FptDeformer.name]
    given = nodes.get("weights")
    if isinstance(given, str) and given != AUTO:
        raise BadInput(
            f"{FptDeformer.name}.weights: '{given}' is not valid, it takes a list of numbers, or "
            f"{AUTO}"
        )
    if given == AUTO:
        del nodes["weights"]
    return given == AUTO


def weights_of(loop: Loop) -> list[float]:
    """Weights of the response errors that make the mean step of each coordinate alike.

    1 / mean diagonal of J = df/dr along the nominal motion, of M^-1 M^ for an arm: it takes the
    exact plant, as a simulation has it.
    """
    return [1.0 / mean for mean in mean_diagonal(loop)]
