"""The commands, as their users call them."""

import json
import signal

import pytest
from command import forked_fpt, forked_fpt_json, fpt_json, start_fpt

KEYS = {
    "experiment", "variant", "engine", "cycles", "dt", "duration", "settle_time", "seed",
    "tracking", "effort", "chatter", "final_parameters", "wall_time", "cycles_per_second", "bag",
}  # fmt: skip


def test_simulate_json_is_what_the_design_agreed():
    result = fpt_json("simulate", "tora")
    assert result.keys() >= KEYS
    assert (result["experiment"], result["variant"]) == ("tora", "adaptive")
    assert (result["engine"], result["cycles"], result["dt"]) == ("in_process", 16000, 0.001)
    assert (result["duration"], result["settle_time"], result["seed"]) == (16.0, 4.0, 0)
    assert result["bag"] is None
    assert result["tracking"].keys() == {"q3", "q2"}
    assert result["tracking"]["q3"].keys() == {"rms", "max", "rms_settled", "max_settled"}
    assert result["tracking"]["q3"]["rms_settled"] == pytest.approx(3.169e-4, rel=1e-3)
    assert result["effort"]["q1"].keys() == {"rms", "max"}
    assert result["final_parameters"]["m"] == 10.0


def test_list_names_everything():
    experiments = {e["experiment"]: e for e in forked_fpt_json("list")["experiments"]}
    assert list(experiments["tora"]["variants"]) == [
        "adaptive", "chatter", "guarded", "lossy", "nonadaptive", "rotation", "rough", "strong",
    ]  # fmt: skip
    assert set(experiments["vdp_rfpt"]["variants"]) == {
        "adaptive", "no_rfpt", "fixed_model", "fixed_model_no_rfpt", "undisturbed",
    }  # fmt: skip
    assert "Figs 3.21-3.27" in experiments["tora"]["thesis"]
    text = forked_fpt("list").stdout
    assert "fixed_model_no_rfpt" in text


def test_record_info_report(tmp_path):
    bag = tmp_path / "bag"
    result = forked_fpt_json("simulate", "tora", "--duration", 6, "--record", bag)
    assert result["bag"] == str(bag)
    info = forked_fpt_json("info", bag)
    assert info["complete"] is True
    assert info["topics"]["/desired"]["messages"] == 6000
    assert info["parameters"]["fpt_deformer"]["A"] == -0.1
    assert "joint_states" in forked_fpt("info", bag).stdout
    both = forked_fpt_json("report", bag, bag, "--out", tmp_path / "report")["runs"]
    assert [run["tracking"] for run in both] == [result["tracking"]] * 2
    page = (tmp_path / "report" / "index.html").read_text()
    assert page.count('<figure class="card"') == 7
    assert not (tmp_path / "report" / "figures").exists()


def test_divergence_of_the_engine(tmp_path):
    done = forked_fpt(
        "simulate", "tora", "--set", "fpt_deformer.A=0.1", "--record", tmp_path / "b", "--json"
    )
    assert done.returncode == 1
    assert "diverged at t = 0.411 s: the position of q1" in done.stderr
    result = json.loads(done.stdout)
    assert result["cycles"] == 412
    assert result["complete"] is False
    assert forked_fpt_json("info", tmp_path / "b")["complete"] is False


def test_interrupted_engine_closes_its_recording(tmp_path):
    process = start_fpt("simulate", "vdp_rfpt", "--duration", 400, "--record", tmp_path / "bag")
    assert "vdp_rfpt adaptive" in process.stderr.readline()  # it has begun
    process.send_signal(signal.SIGINT)
    _, stderr = process.communicate(timeout=120)
    assert process.returncode == 130, stderr
    assert "interrupted" in stderr
    assert "Traceback" not in stderr
    assert forked_fpt_json("info", tmp_path / "bag")["complete"] is False


def test_a_file_of_ones_own(tmp_path):
    from fpt_ros.experiments.locate import config_directory

    text = (config_directory() / "tora.yaml").read_text()
    (tmp_path / "mine.yaml").write_text(text.replace("A: -0.1", "A: -0.5"))
    result = forked_fpt_json("simulate", tmp_path / "mine.yaml", "--duration", 5)
    assert result["experiment"] == "mine"
    assert result["tracking"]["q3"]["rms_settled"] < 1e-4 * 3


@pytest.mark.parametrize(
    "command",
    [
        "list",
        "simulate",
        "sweep",
        "tune",
        "run",
        "report",
        "gain",
        "denoise",
        "info",
        "reproduce",
        "demo",
    ],
)
def test_help_has_an_example(command):
    done = forked_fpt(command, "--help")
    assert done.returncode == 0
    assert f"Example: fpt {command}" in done.stdout


def test_demo(tmp_path):
    done = forked_fpt("demo", "--out", tmp_path, "--duration", 2)
    assert done.returncode == 0, done.stderr
    (folder,) = tmp_path.iterdir()
    page = (folder / "report" / "index.html").read_text()
    assert "nonadaptive" in page
    assert str(folder / "report" / "index.html") in done.stdout
    assert {path.name for path in folder.iterdir()} == {
        "tora_adaptive",
        "tora_nonadaptive",
        "report",
    }
