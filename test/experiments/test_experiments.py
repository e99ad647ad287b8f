"""Experiments: loading, variants, settings, and every reason to refuse."""

import shutil

import pytest

from fpt_ros.cycle.parameter_tuner import in_the_loop
from fpt_ros.errors import BadInput
from fpt_ros.experiments import experiment, parameter_file
from fpt_ros.experiments.experiment import load
from fpt_ros.experiments.locate import config_directory

NODES = (
    "plant_simulator",
    "denoiser",
    "trajectory_generator",
    "parameter_tuner",
    "fpt_deformer",
    "recorder",
)
WITHOUT_TUNER = {
    "method": "none",
    "precursor": False,
    "precursor_guard": False,
    "realtime": False,
}


def without_tuner(joints, controlled, dt):
    """Parameters of a tuner that does nothing; it knows plant and motion all the same."""
    return {**WITHOUT_TUNER, "joints": joints, "controlled": controlled, "cycle_time": dt}


def refused(*args, **kwargs):
    with pytest.raises(BadInput) as caught:
        experiment.load(*args, **kwargs)
    message = str(caught.value)
    assert "\n" not in message
    assert caught.value.exit_status == 2
    return message


@pytest.fixture
def own(tmp_path):
    """A copy of the TORA file that a test may spoil; returns (path, replace)."""
    path = tmp_path / "mine.yaml"
    shutil.copy(config_directory() / "tora.yaml", path)

    def replace(old, new):
        content = path.read_text()
        assert old in content
        path.write_text(content.replace(old, new))

    return path, replace


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
    assert found["tora"] == ["adaptive", "chatter", "guarded", "nonadaptive", "strong"]
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
    assert message.startswith("plant_simulator has no parameter 'approximate.m': it has await_rec")


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


def test_a_motion_out_of_the_workspace_is_refused_whatever_came_before():
    wide = ["trajectory_generator.amplitude=[2.0, 0.5]"]
    for _ in range(2):
        experiment.load("tora")
        assert "out of the workspace" in refused("tora", settings=wide)
    experiment.load("tora", settings=["plant_simulator.exact.m=9"])


def test_unknown_names_list_what_there_is():
    assert refused("toar").startswith("no experiment 'toar': there are ")
    assert ", ".join(experiment.available()) in refused("toar")
    expected = "tora has no variant 'weak': it has adaptive, chatter, guarded, nonadaptive, strong"
    assert refused("tora", "weak") == expected
    assert refused("tora", "../x") == "../x cannot be read: No such file or directory"
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
        ("trajectory_generator.error_relaxation=p", "none of the relaxations: pd, pi, pid, value"),
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


@pytest.mark.parametrize("section", NODES)
def test_a_missing_section(own, section):
    path, replace = own
    replace(f"/**/{section}:", f"/**/{section}_gone:")
    message = refused(str(path))
    assert message == f"{path} lacks the section '{section}': it takes {', '.join(NODES)}"


def test_a_section_too_many_is_told_of_the_file_that_has_it(own):
    path, _ = own
    extra = "/**/plant:\n  ros__parameters: {dt: 1.0}\n"
    overlay = path.with_name("mine.more.yaml")
    overlay.write_text(extra)
    expected = f"there is no node 'plant', only {', '.join(NODES)}"
    assert refused(str(path), "more") == f"{overlay}: {expected}"
    path.write_text(path.read_text() + extra)
    assert refused(str(path)) == f"{path}: {expected}"


def test_a_missing_parameter(own):
    path, replace = own
    replace("    dt: 0.001\n", "")
    assert refused(str(path)) == "plant_simulator.dt is missing: it takes a number > 0 [s]"


def test_a_misspelt_parameter(own):
    path, replace = own
    replace("    guard: true\n", "    gaurd: true\n")
    assert refused(str(path)).startswith("fpt_deformer has no parameter 'gaurd': it has ")


def test_a_misspelt_shared_parameter(own):
    path, replace = own
    replace("    model: tora\n", "    model: tora\n    adaptive_form: 2.0\n")
    message = refused(str(path))
    assert message.startswith(f"{path}: no node has the parameter 'adaptive_form' of the section")
    assert "adaptive_from" in message


def test_a_misspelt_parameter_in_a_variant(own):
    path, _ = own
    overlay = path.with_name("mine.bad.yaml")
    overlay.write_text("/**/fpt_deformer:\n  ros__parameters: {a: -0.05}\n")
    assert refused(str(path), "bad").startswith("fpt_deformer has no parameter 'a': it has A, ")


def test_a_file_that_is_missing_or_no_yaml(tmp_path):
    assert "cannot be read: No such file" in refused(str(tmp_path / "none.yaml"))
    (tmp_path / "bad.yaml").write_text("a: [")
    assert "is not YAML" in refused(str(tmp_path / "bad.yaml"))


# --- every shipped file

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


# --- noise


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
