"""Overlays by their path, and what cannot be one."""

import shutil

import pytest
from refusals import refused

from fpt_ros.experiments import experiment
from fpt_ros.experiments.locate import config_directory


@pytest.mark.parametrize("folder", ["", "deeper"])
def test_an_overlay_by_its_path_is_the_variant(tmp_path, monkeypatch, folder):
    """Wherever the file lies and whatever it is called, relative or absolute."""
    monkeypatch.chdir(tmp_path)
    path = tmp_path / folder / "precise.yaml"
    path.parent.mkdir(exist_ok=True)
    shutil.copy(config_directory() / "vdp_rfpt.fixed_model.yaml", path)
    by_name = experiment.load("vdp_rfpt", "fixed_model", ["fpt_deformer.A=-0.2"])
    for given in (str(path), str(path.relative_to(tmp_path))):
        loaded = experiment.load("vdp_rfpt", given, ["fpt_deformer.A=-0.2"])
        assert loaded.variant == loaded.about["variant"] == "precise"
        changed = loaded.with_values("fpt_deformer", A=1.0).for_graph(realtime=True)
        assert changed.source == ("vdp_rfpt", "--variant", given)
        loaded.nodes["recorder"]["variant"] = "fixed_model"
        assert loaded.nodes == by_name.nodes


def test_an_overlay_by_its_path_over_a_file_of_ones_own(own, tmp_path):
    path, _ = own
    overlay = tmp_path / "any.gentle.yml"
    overlay.write_text("/**/fpt_deformer:\n  ros__parameters: {A: -0.05}\n")
    loaded = experiment.load(str(path), str(overlay))
    assert (loaded.name, loaded.variant) == ("mine", "any.gentle")
    assert loaded.nodes["fpt_deformer"]["A"] == -0.05


@pytest.mark.parametrize(
    ("file", "text", "reason"),
    [
        ("a.yaml", "a: [1,", "is not YAML"),
        ("a.yaml", "fpt_deformer: 3", "has to hold a map 'ros__parameters'"),
        ("a.yaml", "foo: {ros__parameters: {A: 1.0}}", "there is no node 'foo', only plant_simul"),
        ("a.yaml", "fpt_deformer: {ros__parameters: {Q: 1.0}}", "has no parameter 'Q': it has A"),
        ("a.yaml", "fpt_deformer: {ros__parameters: {K: 3.0}}", "K: 3.0 is not valid"),
        ("a.yaml", "/**: {ros__parameters: {Q: 1.0}}", "no node has the parameter 'Q'"),
        (
            "swing.strong.yaml",
            "fpt_deformer: {ros__parameters: {A: -1.0}}",
            "is of the experiment swing, not of tora",
        ),
        (
            "a.yaml",
            "recorder: {ros__parameters: {experiment: swing}}",
            "is of the experiment swing, not of tora",
        ),
    ],
)
def test_overlays_by_their_path_that_cannot_be(tmp_path, file, text, reason):
    (tmp_path / file).write_text(text)
    assert reason in refused("tora", str(tmp_path / file))


def test_an_overlay_that_is_not_there(tmp_path):
    path = tmp_path / "none.yaml"
    assert refused("tora", str(path)) == f"{path} cannot be read: No such file or directory"
    assert refused("tora", f"{tmp_path}/") == f"{tmp_path} cannot be read: Is a directory"


def test_what_is_written_loads_as_the_same_experiment(tmp_path):
    for name, variant in (("tora", "strong"), ("vdp_rfpt", "fixed_model")):
        original = experiment.load(name, variant)
        path = tmp_path / f"{name}.yaml"
        original.write(path)
        again = experiment.load(str(path))
        again.nodes["recorder"]["variant"] = variant
        assert again.nodes == original.nodes


def test_with_values_leaves_the_original_alone():
    original = experiment.load("tora")
    changed = original.with_values("plant_simulator", realtime=True)
    assert changed.nodes["plant_simulator"]["realtime"] is True
    assert original.nodes["plant_simulator"]["realtime"] is False
    assert changed.nodes["fpt_deformer"] == original.nodes["fpt_deformer"]
