"""An arm in the loop: the engine compiled, as Python, and stage by stage have the same bits."""

import subprocess
import sys
from hashlib import sha256
from pathlib import Path

import numpy as np
import pytest

from fpt_ros.cycle.run import Run
from fpt_ros.engine.engine import Engine
from fpt_ros.experiments import experiment
from fpt_ros.plants.mujoco.description_file import ARMS

mujoco = pytest.importorskip("mujoco")

PICKED_UP = ("plant_simulator.exact.tool_from=0.1",)
PUSHED = (
    "plant_simulator.disturbance.kind=sine_noise",
    "plant_simulator.disturbance.amplitude=5.0",
    "plant_simulator.disturbance.coordinate=joint2",
)


def loaded(variant, settings):
    return experiment.load("panda", variant, settings, 0.3, None)


def bytes_of(topics):
    return {
        (topic, vector): numbers.tobytes()
        for topic, series in topics.items()
        for vector, numbers in series.vectors.items()
    }


@pytest.mark.parametrize(
    ("variant", "settings"),
    [
        ("adaptive", (*PICKED_UP, *PUSHED)),
        ("pd_gravity", ()),
        ("time_delay", ()),
        ("delayed", ()),
        ("state_observer", ()),
        ("super_twisting", ()),
        ("slotine_li", ()),
    ],
)
def test_the_same_bits_in_every_way(variant, settings):
    compiled = Engine(loaded(variant, settings).loop())
    compiled.run()
    plain = Engine(loaded(variant, settings).loop(), compile_laws=False)
    plain.run()
    topics = compiled.topics()
    assert bytes_of(topics) == bytes_of(plain.topics())
    count = dict.fromkeys(topics, 0)
    for topic, frame in Run(loaded(variant, settings).loop()).frames():
        at = count[topic.name]
        count[topic.name] += 1
        for vector, numbers in topics[topic.name].vectors.items():
            expected = np.array(getattr(frame, vector))
            assert numbers[at].tobytes() == expected.tobytes(), (topic.name, vector, at)
    assert set(count.values()) == {300}


def whole_run():
    """20 s of an arm without a tool: what is measured, and the efforts that were asked for."""
    settings = ("plant_simulator.exact.tool=0.0",)
    engine = Engine(experiment.load("panda", "adaptive", settings, 20.0, None).loop())
    engine.run()
    topics = engine.topics()
    return topics["joint_states"].vectors, topics["command"].vectors["effort"]


def digest():
    measured, effort = whole_run()
    return sha256(b"".join(each.tobytes() for each in (*measured.values(), effort))).hexdigest()


def test_twenty_thousand_steps_are_those_of_the_bindings_and_of_a_second_process():
    measured, effort = whole_run()
    model = mujoco.MjModel.from_xml_path(str(ARMS / "panda.xml"))
    data = mujoco.MjData(model)
    data.qpos[:] = measured["position"][0]
    positions = np.empty_like(measured["position"])
    for k, asked in enumerate(effort):
        positions[k] = data.qpos
        data.qfrc_applied[:] = asked
        mujoco.mj_step(model, data)
    assert len(positions) == 20_000
    assert positions.tobytes() == measured["position"].tobytes()
    program = "from test_arms import digest; print(digest())"
    ran = subprocess.run(
        [sys.executable, "-c", program],
        capture_output=True,
        text=True,
        cwd=Path(__file__).parent,
        check=True,
    )
    assert ran.stdout.strip() == digest()


def test_no_address_stands_among_the_parameters():
    for node in experiment.load("panda").nodes.values():
        for value in node.values():
            assert not (isinstance(value, int | float) and abs(value) > 1e9), node


def test_half_of_the_model_costs_little_after_the_transformation():
    """An arm with half of all inertias in the model, from 2.5 s on.

    Two cycles of delay in the sensors are made up for only where the deformer is told of them.
    """
    errors = []
    for variant in ("adaptive", "delayed", "computed_torque"):
        engine = Engine(experiment.load("panda", variant, (), 3.5, None).loop())
        engine.run()
        topics = engine.topics()
        late = topics["desired"].time >= 2.5
        nominal = topics["desired"].vectors["positions"]
        error = (nominal - topics["state_estimate"].vectors["positions"])[late]
        errors.append(float(np.sqrt(np.mean(error**2))))
    assert errors[0] < 1.5e-4
    assert errors[1] < 5e-4
    assert errors[2] > 300.0 * errors[0]
