"""The package builds as ament_python under colcon, as on a stock Jazzy."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import samples

ROOT = Path(__file__).parents[1]
BIN = Path(sys.executable).parent
COPIED = (
    "fpt_ros",
    "config",
    "launch",
    "layouts",
    "resource",
    "setup.py",
    "setup.cfg",
    "package.xml",
    "pyproject.toml",
)


def test_colcon_build(tmp_path):
    source = tmp_path / "src" / "fpt_ros"
    source.mkdir(parents=True)
    for name in COPIED:
        path = ROOT / name
        copy = shutil.copytree if path.is_dir() else shutil.copy
        copy(path, source / name)
    environment = {
        **os.environ,
        "AMENT_PREFIX_PATH": sys.prefix,
        "PATH": f"{BIN}:{os.environ['PATH']}",
    }
    done = subprocess.run(
        [BIN / "colcon", "build", "--event-handlers", "console_direct+"],
        cwd=tmp_path, env=environment, capture_output=True, text=True, timeout=300, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stdout + done.stderr
    prefix = tmp_path / "install" / "fpt_ros"
    share = prefix / "share" / "fpt_ros"
    assert (prefix / "share/ament_index/resource_index/packages/fpt_ros").is_file()
    assert {p.name for p in (share / "config").iterdir()} == {
        p.name for p in (ROOT / "config").iterdir()
    }
    assert (share / "launch" / "experiment.launch.py").is_file()
    assert (share / "layouts" / "foxglove_tora.json").is_file()
    executables = {p.name for p in (prefix / "lib" / "fpt_ros").iterdir()}
    assert executables >= {
        "fpt", "plant_simulator", "denoiser", "trajectory_generator", "parameter_tuner",
        "fpt_deformer", "recorder",
    }  # fmt: skip
    # what ros2 run does: the installed executable, from an empty folder, with the installed config
    words = "simulate tora --duration 1" if samples.whole else "list"  # no compiling from cold
    command = f"{prefix}/lib/fpt_ros/fpt {words} --json"
    run = subprocess.run(
        ["bash", "-c", f". {tmp_path}/install/setup.bash && {command}"],
        cwd=tmp_path, env=environment, capture_output=True, text=True, timeout=240, check=False,
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    assert ('"cycles": 1000' if samples.whole else '"adaptive"') in run.stdout
