"""Every value that an experiment refuses, and what it says."""

import pytest
from refusals import NODES, refused

from fpt_ros.experiments import experiment
from fpt_ros.experiments.locate import config_directory


def test_a_motion_out_of_the_workspace_is_refused_whatever_came_before():
    wide = ["trajectory_generator.amplitude=[2.0, 0.5]"]
    for _ in range(2):
        experiment.load("tora")
        assert "out of the workspace" in refused("tora", settings=wide)
    experiment.load("tora", settings=["plant_simulator.exact.m=9"])


def test_unknown_names_list_what_there_is():
    assert refused("toar").startswith("no experiment 'toar': there are ")
    assert ", ".join(experiment.available()) in refused("toar")
    known = "adaptive, chatter, guarded, lossy, nonadaptive, rotation, rough, strong"
    expected = f"tora has no variant 'weak': it has {known}"
    assert refused("tora", "weak") == expected
    assert (
        refused("tora", "../not/there") == "../not/there cannot be read: No such file or directory"
    )
    assert refused("tora", settings=["plant.dt=1"]) == (
        "there is no node 'plant': there are " + ", ".join(NODES)
    )
    message = refused("tora", settings=["fpt_deformer.Gain=1"])
    assert message.startswith("fpt_deformer has no parameter 'Gain': it has A, D, K, adaptive_from")
    message = refused("tora", settings=["fpt_deformer.transformation=magic"])
    assert message.startswith("'magic' is none of the transformations: none, ")
    assert "rfpt" in message
    assert "sgfpt" in message
    message = refused("vdp_rfpt", settings=["parameter_tuner.method=magic"])
    assert message.startswith("'magic' is none of the tuning laws: none, ")
    assert "projection" in message
    for setting, valid in (
        ("plant_simulator.plant=x", "swing, tora, van_der_pol"),
        ("fpt_deformer.model=x", "swing, tora, van_der_pol"),
        ("trajectory_generator.trajectory=x", "spline"),
        ("plant_simulator.disturbance.kind=x", "bspline"),
        ("denoiser.method=x", "none"),
    ):
        message = refused("tora", settings=[setting])
        assert message.startswith("'x' is none of the ")
        assert valid in message


@pytest.mark.parametrize("setting", ["fpt_deformer.A", "A=1", "=1", "fpt_deformer.=1", "a b", ""])
def test_a_setting_has_a_form(setting):
    message = refused("tora", settings=[setting])
    assert message == (f"--set {setting}: it takes NODE.PARAM=VALUE, as in fpt_deformer.A=-0.2")


@pytest.mark.parametrize(
    ("setting", "reason"),
    [
        ("fpt_deformer.A=fast", "fpt_deformer.A: 'fast' is not valid, it takes a number"),
        ("fpt_deformer.A=", "fpt_deformer.A is missing: it takes a number"),
        ("fpt_deformer.A=[1,", "'[1,' is not a YAML value"),
        ("fpt_deformer.A=.nan", "fpt_deformer.A: nan is not valid"),
        ("fpt_deformer.K=0", "fpt_deformer.K: 0 is not valid, it takes a number > 0 and <= 2"),
        ("fpt_deformer.K=1.9", "K = 1.9 and D = 0.6 give no fixed point"),
        ("fpt_deformer.form=odd", "it takes one of norm, signed"),
        ("fpt_deformer.guard=1", "fpt_deformer.guard: 1 is not valid, it takes true or false"),
        ("fpt_deformer.adaptive_from=-1", "it takes a number >= 0 [s]"),
        ("plant_simulator.substeps=0", "it takes an integer of 64 bits >= 1 and <= 1000"),
        ("plant_simulator.substeps=1.5", "plant_simulator.substeps: 1.5 is not valid"),
        ("plant_simulator.seed=-1", "plant_simulator.seed: -1 is not valid"),
        ("plant_simulator.plant=3", "plant_simulator.plant: 3 is not valid, it takes a word"),
        ("plant_simulator.exact.m=0", "plant_simulator.exact.m: 0 is not valid"),
        ("plant_simulator.noise.position=-1", "it takes a number >= 0"),
        ("plant_simulator.dt=0", "plant_simulator.dt: 0 is not valid, it takes a number > 0 [s]"),
        ("plant_simulator.dt=-0.001", "it takes a number > 0 [s]"),
        ("plant_simulator.dt=1.5e-9", "dt: 1.5e-09 s is not a whole number of nanoseconds"),
        ("plant_simulator.dt=0.0003333333333", "is not a whole number of nanoseconds"),
        ("plant_simulator.dt=1e-12", "is not a whole number of nanoseconds"),
        ("plant_simulator.duration=0", "plant_simulator.duration: 0 is not valid"),
        ("plant_simulator.duration=-3.0", "it takes a number > 0 [s]"),
        ("plant_simulator.duration=0.0001", "duration is shorter than one cycle of 0.001 s"),
        ("plant_simulator.initial_position=[0, 1]", "2 numbers given, 3 needed (q1, q2, q3)"),
        ("plant_simulator.limit.position=[1]", "limit.position: 1 numbers given, 3 needed"),
        ("plant_simulator.disturbance.coordinate=q9", "no coordinate 'q9', only q1, q2, q3"),
        ("trajectory_generator.amplitude=[1.0]", "amplitude: 1 given, 2 needed (q3, q2)"),
        ("trajectory_generator.frequency=[]", "frequency: 0 given, 2 needed (q3, q2)"),
        ("trajectory_generator.lambda=0", "it takes a number > 0 [1/s]"),
        ("trajectory_generator.error_relaxation=p", "none of the relaxations: feedback_pd, "),
        ("trajectory_generator.controlled=[q1, q2]", "response of 'q1', only of q2, q3"),
        ("trajectory_generator.controlled=[q2, q2]", "it takes one or more different coordinates"),
        ("trajectory_generator.controlled=[]", "it takes one or more different coordinates"),
        ("trajectory_generator.controlled=q2", "it takes a list of words"),
        ("recorder.settle_time=-1", "recorder.settle_time: -1 is not valid"),
        ("fpt_deformer.await_tuning=true", "await_tuning follows from parameter_tuner.method"),
    ],
)
def test_bad_values_of_tora(setting, reason):
    assert reason in refused("tora", settings=[setting])


def test_duration_and_seed_arguments_are_checked_too():
    assert "plant_simulator.duration: 0 is not valid" in refused("tora", duration=0)
    assert "plant_simulator.duration: inf is not valid" in refused("tora", duration=float("inf"))
    assert "plant_simulator.seed: -1 is not valid" in refused("tora", seed=-1)


@pytest.mark.parametrize(
    ("name", "variant", "setting"),
    [
        ("tora", "nonadaptive", "fpt_deformer.A=-0.2"),
        ("tora", "nonadaptive", "fpt_deformer.D=0.6"),
        ("vdp_rfpt", "fixed_model", "parameter_tuner.alpha=2.0"),
        ("vdp_rfpt", "fixed_model", "parameter_tuner.approximate.m=8.0"),
        ("tora", "adaptive", "fpt_deformer.B=1.0"),
        ("tora", "adaptive", "parameter_tuner.model=van_der_pol"),
    ],
)
def test_a_parameter_of_a_law_that_is_not_in_use_cannot_be_set(name, variant, setting):
    node, parameter = setting.partition("=")[0].split(".", 1)
    message = refused(name, variant, [setting])
    assert message.startswith(f"{node} has no parameter '{parameter}': it has ")


def test_a_law_and_its_old_parameter_cannot_be_set_together():
    settings = ["fpt_deformer.transformation=none", "fpt_deformer.A=-0.2"]
    assert refused("tora", settings=settings).startswith("fpt_deformer has no parameter 'A'")


def test_a_tuner_needs_a_model_that_is_linear():
    message = refused("tora", settings=["parameter_tuner.method=projection"])
    assert "parameter_tuner.method: projection tunes models that are linear" in message


def test_model_and_plant_have_the_same_coordinates():
    changes = [f"fpt_deformer.approximate.{x}=1.0" for x in ("mu", "c", "k", "beta", "lambda")]
    message = refused("tora", settings=["fpt_deformer.model=van_der_pol", *changes])
    assert message == (
        "fpt_deformer.model: van_der_pol has the coordinates q1, the plant q1, q2, q3"
    )


def test_tuner_and_deformer_have_the_same_model(own, tmp_path):
    path = tmp_path / "mixed.yaml"
    content = (config_directory() / "vdp_rfpt.yaml").read_text()
    other = "    model: tora\n    approximate: {M: 1.0, L: 1.0, theta: 1.0, g: 9.81}\n"
    path.write_text(
        content.replace("    transformation: rfpt\n", "    transformation: rfpt\n" + other)
    )
    message = refused(str(path), settings=["plant_simulator.plant=tora", *(
        f"plant_simulator.exact.{x}=1.0" for x in ("M", "L", "theta", "g")
    ), "plant_simulator.initial_position=[]", "plant_simulator.initial_velocity=[]",
        "plant_simulator.limit.position=[]", "trajectory_generator.controlled=[q2]"])  # fmt: skip
    assert message == "parameter_tuner.model: van_der_pol is not the deformer's, tora"
