"""Every experiment of the package."""

import pytest

from fpt_ros import notices
from fpt_ros.cycle.parameter_tuner import in_the_loop
from fpt_ros.experiments import experiment, parameter_file
from fpt_ros.experiments.experiment import load
from fpt_ros.experiments.locate import config_directory

FILES = sorted(config_directory().glob("*.yaml"))

SHIPPED = [(name, each) for name, found in experiment.available().items() for each in found]


@pytest.mark.parametrize(("name", "variant"), SHIPPED)
def test_every_shipped_experiment_loads_and_describes_itself(name, variant):
    loaded = experiment.load(name, variant)
    loop = loaded.loop()
    for key in ("title", "shows", "thesis"):
        assert loaded.about[key], key
    assert 0.0 < loaded.about["settle_time"] < loaded.nodes["plant_simulator"]["duration"]
    assert loop.tuner.active is loaded.about["await_tuning"]
    if variant != "adaptive":
        assert loaded.about["shows"] != experiment.load(name).about["shows"]
        assert loaded.nodes != {**experiment.load(name).nodes, "recorder": loaded.about}


@pytest.mark.parametrize(("name", "variant"), SHIPPED)
def test_await_tuning_in_the_files_themselves_agrees_with_the_tuner(name, variant):
    """As ROS reads them, base and overlay one after the other: the loader corrects nothing."""
    file = parameter_file.read(config_directory() / f"{name}.yaml")
    if variant != "adaptive":
        overlay = parameter_file.read(config_directory() / f"{name}.{variant}.yaml")
        file = file.overlay(overlay)
    in_loop = in_the_loop(file.nodes["parameter_tuner"])
    for node in ("fpt_deformer", "recorder"):
        merged = {**file.shared, **file.nodes[node]}
        assert merged.get("await_tuning", False) is in_loop


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_shipped_files_give_numbers_the_type_that_ros_wants(path):
    """ROS does not take 1 for a double: a number parameter is written with a decimal point."""
    name, _, variant = path.stem.partition(".")
    loaded = experiment.load(name, variant or "adaptive")
    file = parameter_file.read(path)
    for node, values in file.nodes.items():
        for key, value in {**file.shared, **values}.items():
            checked = loaded.nodes[node].get(key)
            if isinstance(checked, float):
                assert type(value) is float, f"{node}.{key}"
            if isinstance(checked, list) and checked and isinstance(checked[0], float):
                assert all(type(x) is float for x in value), f"{node}.{key}"


def without_a_filter(tmp_path, noise):
    text = (config_directory() / "tora.yaml").read_text().replace("    method: none\n", "", 1)
    lines = text.splitlines()
    at = next(i for i, line in enumerate(lines) if line.startswith("/**/denoiser"))
    assert "ros__parameters" in lines[at + 1]
    lines.insert(at + 2, "    order: 2")
    plant = next(i for i, line in enumerate(lines) if line.startswith("/**/plant_simulator"))
    lines.insert(plant + 2, f"    noise: {{position: {noise}}}")
    path = tmp_path / "own.yaml"
    path.write_text("\n".join(lines))
    return str(path)


def test_noise_is_filtered_where_nobody_has_chosen(tmp_path):
    path = without_a_filter(tmp_path, 1e-4)
    assert load(path).nodes["denoiser"]["method"] == "kalman_bank"
    assert load(path, settings=["denoiser.method=none"]).nodes["denoiser"]["method"] == "none"
    quiet = load(path, settings=["plant_simulator.noise.position=0.0"])
    assert quiet.nodes["denoiser"]["method"] == "none"
    assert load("tora").nodes["denoiser"]["method"] == "none"


def test_a_ladder_is_not_synchronised_in_silence(capsys):
    synchronised = ["denoiser.synchronised=true", "fpt_deformer.synchronised=true"]
    notices.notice.cache_clear()
    load("noisy_tora")
    assert capsys.readouterr().err == ""
    load("tora", settings=["denoiser.method=kalman_bank", *synchronised])
    assert "two banks of several filters do not filter alike; give" in capsys.readouterr().err
