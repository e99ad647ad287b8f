"""Whether the stages of a loop fit each other."""

from fpt_ros.cycle.stages import Loop
from fpt_ros.denoising.streaming import given_filters
from fpt_ros.denoising.streaming.kalman_bank import KALMAN_BANK
from fpt_ros.errors import BadInput
from fpt_ros.experiments.law_check import check_laws
from fpt_ros.experiments.workspace import check_workspace
from fpt_ros.notices import notice
from fpt_ros.parameters import word
from fpt_ros.relaxations import RELAXATIONS
from fpt_ros.tuning import COEFFICIENTS

MOTIONS = 32
"""Nominal motions that a process remembers to be within the workspace."""


def check_fit(loop: "Loop") -> None:
    """The stages are of one plant, and can do what is asked of them.

    Raises:
        BadInput: they are not, or cannot.
    """
    plant, model = loop.plant.coordinates, loop.deformer.coordinates
    if model != plant:
        raise BadInput(
            f"fpt_deformer.model: {word(loop.deformer.values, 'model')} has the coordinates "
            f"{', '.join(model)}, the plant {', '.join(plant)}"
        )
    loop.deformer.check_controlled(loop.trajectory.controlled)
    loop.deformer.weights_of(loop.trajectory.controlled)
    loop.trajectory.locate(plant)
    order = loop.plant.plant.order
    name = word(loop.plant.values, "plant")
    given = loop.denoiser.values["order"]
    if given != order:
        raise BadInput(
            f"denoiser.order: {given} given, the plant {name} answers with order {order}"
        )
    relaxation, used = loop.trajectory.relaxation, loop.trajectory.values["error_relaxation"]
    if relaxation.order != order:
        fitting = [each for each in RELAXATIONS.names() if RELAXATIONS[each].order == order]
        raise BadInput(
            f"trajectory_generator.error_relaxation: {used} is for a response of order "
            f"{relaxation.order}, the plant {name} answers with order {order}: "
            f"{' or '.join(fitting)}"
        )
    for stage in loop.answering():
        if "cycle_time" in stage.values and stage.values["cycle_time"] not in (0.0, loop.plant.dt):
            raise BadInput(
                f"{stage.name}.cycle_time: {stage.values['cycle_time']} s given, the plant's dt is "
                f"{loop.plant.dt} s"
            )
    tunes = loop.tuner.active and loop.tuner.law.tunes == COEFFICIENTS
    if tunes and loop.tuner.values["model"] != loop.deformer.values["model"]:
        raise BadInput(
            f"parameter_tuner.model: {word(loop.tuner.values, 'model')} is not the deformer's, "
            f"{word(loop.deformer.values, 'model')}"
        )
    denoiser = loop.denoiser
    is_bank = denoiser.filter is KALMAN_BANK
    if denoiser.synchronised and is_bank and len(given_filters.given(denoiser.values)[1]) > 1:
        notice(
            "denoiser.synchronised: two banks of several filters do not filter alike; give "
            "kalman_bank one (states, densities, sigma)"
        )
    check_laws(loop)
    _check_motion(loop)


def _check_motion(loop: "Loop") -> None:
    """The nominal motion stays in the plant's workspace; a motion found good is not asked again."""
    plant, trajectory = loop.plant, loop.trajectory
    if plant.plant.workspace is None:
        return
    key = (
        plant.coordinates,
        tuple(plant.plant.workspace(plant.coefficients)),
        plant.cycles,
        plant.dt,
        trajectory.trajectory.nominal,
        trajectory.controlled,
        tuple(trajectory.constants.nominal),
    )
    if key not in _good_motions:
        check_workspace(loop)
        if len(_good_motions) >= MOTIONS:
            _good_motions.pop(next(iter(_good_motions)))
        _good_motions[key] = None


_good_motions: dict[tuple[object, ...], None] = {}
