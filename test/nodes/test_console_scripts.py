"""The nodes one by one, as ``ros2 run fpt_ros NODE --ros-args --params-file config/tora.yaml``."""

import subprocess
from pathlib import Path

import pytest
from command import BIN, forked_fpt_json

from fpt_ros.bags.reader import read_run
from fpt_ros.experiments.locate import config_directory

NODES = ("denoiser", "trajectory_generator", "parameter_tuner", "fpt_deformer")


def start(node, file, *arguments):
    return subprocess.Popen(
        [BIN / node, "--ros-args", "--params-file", file, *arguments],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )


@pytest.mark.parametrize("namespace", ["", "/robot1"])
def test_five_console_scripts_and_a_recorder(tmp_path, namespace):
    file = config_directory() / "tora.yaml"
    bag = tmp_path / "bag"
    remap = ["-r", f"__ns:={namespace}"] if namespace else []
    others = [start(node, file, *remap) for node in NODES]
    recorder = start("recorder", file, "-p", f"directory:={bag}", *remap)
    plant = start(
        "plant_simulator", file, "-p", "duration:=1.0", "-p", "await_recorder:=true", *remap
    )
    try:
        output, _ = plant.communicate(timeout=60)
        assert plant.returncode == 0, output
    finally:
        for process in (plant, *others, recorder):
            process.terminate()
        for process in (*others, recorder):
            process.communicate(timeout=20)
    assert [process.returncode for process in (*others, recorder)] == [0] * 5
    assert forked_fpt_json("info", bag)["topics"][f"{namespace}/command"]["messages"] == 1000
    forked_fpt_json("simulate", "tora", "--duration", 1, "--record", tmp_path / "engine")
    ours, theirs = read_run(tmp_path / "engine"), read_run(bag)
    a, b = ours.topics["command"], theirs.topics["command"]
    assert a.vectors["effort"].tobytes() == b.vectors["effort"].tobytes()


@pytest.mark.parametrize(
    ("node", "arguments", "complaint"),
    [
        ("fpt_deformer", ["-p", "transformation:=foo"], "'foo' is none of the transformations: "),
        ("fpt_deformer", ["-p", "A:=1"], "fpt_deformer.A: a value of the wrong type"),
        ("fpt_deformer", ["-p", "K:=-0.5"], "fpt_deformer.K: the value given is not valid"),
        (
            "plant_simulator",
            ["-p", "plant:=foo"],
            "'foo' is none of the plants: acrobot, affine_map, cart_beam_hamper, ",
        ),
        ("plant_simulator", ["-p", "dt:=-0.5"], "plant_simulator.dt: the value given is not valid"),
        ("denoiser", ["-p", "method:=foo"], "'foo' is none of the filters: "),
        ("recorder", ["-p", "directory:=/proc/bag"], "/proc/bag"),
    ],
)
def test_bad_parameters(node, arguments, complaint):
    process = start(node, config_directory() / "tora.yaml", *arguments)
    try:
        output, _ = process.communicate(timeout=60)
    finally:
        process.kill()
    assert process.returncode == 2
    assert complaint in output
    assert len(output.strip().splitlines()) == 1


def test_missing_parameter_file():
    process = start("denoiser", Path("no/such.yaml"))
    output, _ = process.communicate(timeout=60)
    assert process.returncode == 2
    assert "no/such.yaml" in output.splitlines()[-1]


def test_help_says_how_it_is_run():
    done = subprocess.run([BIN / "denoiser", "--help"], capture_output=True, text=True, check=True)
    assert "ros2 run fpt_ros denoiser --ros-args --params-file" in done.stdout
