"""Experiments: loading, variants, settings, files of one's own."""

import pytest
from refusals import NODES, refused

from fpt_ros.experiments import experiment

WITHOUT_TUNER = {
    "method": "none",
    "precursor": False,
    "precursor_guard": False,
    "realtime": False,
    "autostart": True,
    "ends_with_plant": False,
}


def without_tuner(joints, controlled, dt):
    """Parameters of a tuner that does nothing; it knows plant and motion all the same."""
    return {**WITHOUT_TUNER, "joints": joints, "controlled": controlled, "cycle_time": dt}


def test_the_base_file_is_complete_and_typed():
    loaded = experiment.load("tora")
    assert tuple(loaded.nodes) == NODES
    assert (loaded.name, loaded.variant) == ("tora", "adaptive")
    plant = loaded.nodes["plant_simulator"]
    assert plant["exact.theta"] == 20.0
    assert plant["substeps"] == 1
    assert plant["limit.position"] == [1.5, 1000.0, 1000.0]
    assert loaded.nodes["fpt_deformer"]["approximate.theta"] == 5.0
    tuner = without_tuner(["q1", "q2", "q3"], ["q3", "q2"], 0.001)
    assert loaded.nodes["parameter_tuner"] == tuner
    assert loaded.about["settle_time"] == 4.0
    assert loaded.about["experiment"] == "tora"
    assert loaded.about["variant"] == "adaptive"
    assert loaded.about["await_tuning"] is loaded.nodes["fpt_deformer"]["await_tuning"] is False


def test_available_lists_the_base_first():
    found = experiment.available()
    assert found["tora"] == [
        "adaptive", "chatter", "guarded", "lossy", "nonadaptive", "rotation", "rough", "strong",
    ]  # fmt: skip
    assert found["vdp_rfpt"][0] == "adaptive"
    assert set(found["vdp_rfpt"]) == {
        "adaptive", "no_rfpt", "fixed_model", "fixed_model_no_rfpt", "undisturbed"
    }  # fmt: skip


def test_a_variant_replaces_a_law_with_its_parameters():
    deformer = experiment.load("tora", "nonadaptive").nodes["fpt_deformer"]
    assert deformer["transformation"] == "none"
    assert not {"A", "K", "D", "guard", "form"} & deformer.keys()
    loaded = experiment.load("vdp_rfpt", "fixed_model")
    assert loaded.nodes["parameter_tuner"] == without_tuner(["q1"], ["q1"], 0.001)
    assert loaded.nodes["fpt_deformer"]["await_tuning"] is False
    assert loaded.nodes["fpt_deformer"]["approximate.m"] == 9.0
    assert loaded.about["variant"] == "fixed_model"


def test_settings_replace_a_law_as_a_variant_does():
    by_setting = experiment.load("tora", settings=["fpt_deformer.transformation=none"])
    by_variant = experiment.load("tora", "nonadaptive")
    assert by_setting.nodes["fpt_deformer"] == by_variant.nodes["fpt_deformer"]
    no_tuner = experiment.load("vdp_rfpt", settings=["parameter_tuner.method=none"])
    assert (
        no_tuner.nodes["fpt_deformer"]
        == (experiment.load("vdp_rfpt", "fixed_model").nodes["fpt_deformer"])
    )
    assert no_tuner.about["await_tuning"] is False
    swapped = experiment.load(
        "tora",
        settings=[
            "fpt_deformer.transformation=rfpt",
            "fpt_deformer.A=1e-6",
            "fpt_deformer.K=-1e5",
        ],
    ).nodes["fpt_deformer"]
    assert (swapped["B"], swapped["K"]) == (1.0, -1e5)
    assert "guard" not in swapped


def test_settings_duration_and_seed():
    loaded = experiment.load(
        "tora",
        "strong",
        ["fpt_deformer.A=-2", "plant_simulator.exact.m=21", "recorder.title=no"],
        duration=2,
        seed=7,
    )
    assert loaded.nodes["fpt_deformer"]["A"] == -2.0
    assert loaded.nodes["plant_simulator"]["exact.m"] == 21.0
    assert loaded.nodes["plant_simulator"]["duration"] == 2.0
    assert loaded.nodes["plant_simulator"]["seed"] == 7
    assert loaded.about["title"] == "no"
    assert experiment.load("tora", "strong").nodes["fpt_deformer"]["A"] == -3.125


@pytest.mark.parametrize("node", ["fpt_deformer", "parameter_tuner"])
def test_a_shared_value_is_set_for_all_nodes_that_know_it(node):
    loaded = experiment.load("vdp_rfpt", settings=[f"{node}.approximate.m=8"])
    for name in ("fpt_deformer", "parameter_tuner"):
        assert loaded.nodes[name]["approximate.m"] == 8.0
    assert loaded.nodes["plant_simulator"]["exact.m"] == 10.0


def test_a_value_that_a_node_has_of_its_own_is_set_there(own):
    path, replace = own
    replace("    form: norm\n", "    form: norm\n    approximate: {m: 12.0}\n")
    assert experiment.load(str(path)).nodes["fpt_deformer"]["approximate.m"] == 12.0
    loaded = experiment.load(str(path), settings=["fpt_deformer.approximate.m=8"])
    assert loaded.nodes["fpt_deformer"]["approximate.m"] == 8.0
    assert loaded.nodes["fpt_deformer"]["approximate.M"] == 20.0


def test_a_shared_value_cannot_be_set_through_a_node_that_does_not_know_it():
    message = refused("vdp_rfpt", settings=["plant_simulator.approximate.m=8"])
    assert message.startswith("plant_simulator has no parameter 'approximate.m': it has actuators")


def test_a_file_of_ones_own(own):
    path, replace = own
    replace("A: -0.1", "A: -0.3")
    loaded = experiment.load(str(path))
    assert loaded.name == "mine"
    assert loaded.nodes["fpt_deformer"]["A"] == -0.3
    path.with_name("mine.gentle.yaml").write_text(
        "/**/fpt_deformer:\n  ros__parameters: {A: -0.05}\n"
    )
    assert experiment.load(str(path), "gentle").nodes["fpt_deformer"]["A"] == -0.05
    assert refused(str(path), "rough") == "mine has no variant 'rough': it has adaptive, gentle"


def test_the_deformer_waits_longer_for_a_plant_with_a_slow_clock():
    def timeout(realtime, *settings):
        told = experiment.load("tora", settings=settings).for_graph(realtime)
        assert told.for_graph(realtime).nodes == told.nodes
        told.loop()
        return told.nodes["fpt_deformer"]["command_timeout"]

    slow, short = "plant_simulator.speed=0.01", "fpt_deformer.command_timeout=0.02"
    assert timeout(True) == timeout(False, slow) == 0.1
    assert timeout(True, slow) == 10.0
    assert timeout(True, slow, short) == 2.0
    assert timeout(True, "fpt_deformer.command_timeout=0.0", slow) == 0.0
