"""Hypnosis and freeway traffic: constants and equations against their sources, and the gain."""

import independent_freeway
import independent_hypnosis
import numpy as np
import pytest
from engine_runs import settled_rms, topics_of
from mechanics import respond

from fpt_ros.experiments.experiment import load
from fpt_ros.plants import freeway, hypnosis

# sym-metanet 1.1.2 (FilippoAiraldi/sym-metanet), NumPy engine, after 360 steps of 10 s
DENSITIES = [17.15271622128, 17.182420108864, 17.355438895893, 18.324264531588, 23.582128791817,
             24.32786544905]  # fmt: skip
SPEEDS = [87.45322101986, 87.31581479523, 86.506907798293, 82.117203378453, 78.014863088354,
          76.399150024811]  # fmt: skip


def exact(name, plant):
    given = load(name).nodes["plant_simulator"]
    return [given[f"exact.{parameter.name}"] for parameter in plant.parameters]


def test_the_freeway_against_a_library_for_metanet():
    constants = exact("freeway", freeway.PLANT)
    rho, v = independent_freeway.start()
    q = np.concatenate((rho, v))
    for k in range(360):
        ramp = 900.0 + 300.0 * np.sin(k / 20)
        rho, v = independent_freeway.metanet(rho, v, ramp)
        effort = [0.0] * 12
        effort[4] = ramp
        q = q + 10.0 * np.array(respond(freeway.PLANT, constants, q.tolist(), [0.0] * 12, effort))
    for found in (q, np.concatenate((rho, v))):
        assert found == pytest.approx(DENSITIES + SPEEDS, rel=1e-11)


def test_the_patient_is_one_of_schnider_and_of_the_curves():
    """EC50 4.05207 in per cent of E0, k_d 0.315365 1/min: a row of AReS's table."""
    found = dict(
        zip((p.name for p in hypnosis.PARAMETERS), exact("hypnosis", hypnosis.PLANT), strict=True)
    )
    expected = independent_hypnosis.schnider(56, 154, 59)
    rates = [found[name] for name in ("V1", "k10", "k12", "k21", "k13", "k31")]
    assert rates == pytest.approx(expected, rel=2e-4)
    assert found["E0"] == pytest.approx(92.5909836065574, rel=1e-5)
    assert found["EC50"] == pytest.approx(0.0405207102592622 * 92.5909836065574, rel=1e-4)
    assert (found["ke0"], found["gamma"]) == pytest.approx(
        (0.315365031488, 1.57216796875), rel=2e-4
    )


@pytest.mark.parametrize(
    ("name", "joint", "settle", "low", "high"),
    [("hypnosis", "wav", 900.0, 0.0, 30.0), ("freeway", "rho5", 1200.0, 0.0, 2000.0)],
)
def test_the_deformation_makes_up_for_the_model_with_an_effort_that_there_is(
    name, joint, settle, low, high
):
    topics = topics_of(name)
    effort = topics["command"].column("effort", joint)
    assert low < effort.min() < effort.max() < high
    alone = settled_rms(topics_of(name, "nonadaptive"), settle)[joint]
    assert settled_rms(topics, settle)[joint] < alone / 40.0


def test_no_pump_takes_drug_back():
    topics = topics_of(
        "hypnosis",
        settings=[
            "trajectory_generator.points=[50.0, 70.0, 70.0, 60.0, 60.0, 48.0]",
            "plant_simulator.initial_position=[50.0]",
        ],
    )
    commanded = topics["command"].column("effort", "wav")
    acted = topics["joint_states"].column("effort", "wav")
    assert commanded.min() < 0.0
    assert acted[1:] == pytest.approx(np.maximum(commanded[:-1], 0.0))
