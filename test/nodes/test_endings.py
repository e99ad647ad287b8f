"""However a run ends: the right exit status, a closed recording, and nothing left behind."""

import os
import signal
from contextlib import suppress
from pathlib import Path
from time import monotonic, sleep

import psutil
import pytest
import samples
from command import OSCILLATOR, node_of, start_fpt
from command import forked_fpt as fpt
from command import forked_fpt_json as fpt_json
from watcher import watcher

from fpt_ros.bags.reader import read_run
from fpt_ros.cycle.stages import STAGES

WITHIN = 20.0
LONG = 1000


def in_shared_memory(processes):
    """Files in shared memory that these processes have mapped or open."""
    used = set()
    for process in processes:
        folder = Path(f"/proc/{process.pid}")
        with suppress(OSError):  # it has ended
            maps = (folder / "maps").read_text().splitlines()
            used |= {line[line.index("/") :] for line in maps if "/dev/shm/" in line}
            for descriptor in (folder / "fd").iterdir():
                with suppress(OSError):
                    used.add(os.readlink(descriptor))
    shared = (path.removesuffix(" (deleted)") for path in used if path.startswith("/dev/shm/"))
    return set(map(Path, shared))


def files_of(children):
    """Those of the run alone, and none of Fast DDS: a killed process would break its ports."""
    files = in_shared_memory(children)
    assert not [path for path in files if "fastrtps" in path.name]
    return {path for path in files if "lttng" not in path.name}


def left(files):
    return {path for path in files if path.exists()}


def under_way(tmp_path, *options, of=("tora",)):
    """A run of the graph that has come to t = 0.2 s, and its processes."""
    process = start_fpt("run", *of, "--duration", LONG, "--record", tmp_path / "bag", *options)
    with watcher() as graph:
        graph.wait_for_stamp(0.2)
    return process, psutil.Process(process.pid).children(recursive=True)


def ended(process):
    _, stderr = process.communicate(timeout=60)
    return stderr


def gone(children):
    _, alive = psutil.wait_procs(children, timeout=WITHIN)
    return not alive


@pytest.mark.parametrize("options", [(), ("--composed",), ("--realtime",)])
def test_interrupt(tmp_path, options):
    on_the_wall_clock = "--realtime" in options
    plant = OSCILLATOR if on_the_wall_clock else ("tora",)
    process, children = under_way(tmp_path, *options, of=plant)
    files = files_of(children)
    assert files
    assert len(children) == 1 + (2 if "--composed" in options else 6)  # the first is the nurse
    asked = monotonic()
    process.send_signal(signal.SIGINT)
    stderr = ended(process)
    assert monotonic() - asked < WITHIN
    assert process.returncode == 130, stderr
    assert gone(children)
    assert not left(files)
    run = read_run(tmp_path / "bag")
    assert run.info["complete"] == "false"
    assert "interrupted" in run.info["reason"]
    assert len(run.topics["command"].stamps) > (0 if on_the_wall_clock else 200)
    assert (tmp_path / "bag" / "metadata.yaml").is_file()


def test_a_run_that_is_complete_on_a_busy_machine_is_one(tmp_path):
    """From its start on its processes get a twelfth of the time, as beside dozens of busy ones."""
    process = start_fpt("run", "tora", "--duration", 0.5, "--record", tmp_path / "bag")
    while not list(tmp_path.glob("bag/*.mcap")):  # a node might find it too late
        assert process.poll() is None, ended(process)
        sleep(0.005)
    own = psutil.Process(process.pid)
    processes = [own, *own.children(recursive=True)]
    while process.poll() is None:
        for told, seconds in ((psutil.Process.suspend, 0.055), (psutil.Process.resume, 0.005)):
            for each in processes:
                with suppress(psutil.NoSuchProcess):
                    told(each)
            sleep(seconds)
    assert process.returncode == 0, ended(process)
    run = read_run(tmp_path / "bag")
    assert run.info["complete"] == "true"
    assert len(run.topics["command"].stamps) == 500


NODES = ["plant_simulator", "fpt_deformer", "parameter_tuner", "recorder"]


@pytest.mark.parametrize("name", samples.sample(NODES, 2, keep=("plant_simulator", "recorder")))
def test_killed_node(tmp_path, name):
    process, children = under_way(tmp_path, "--restarts", 0)
    files = files_of(children)
    asked = monotonic()
    node_of(process, name).kill()
    stderr = ended(process)
    assert monotonic() - asked < WITHIN
    assert process.returncode == 1
    assert f"the node {name} was killed by SIGKILL" in stderr
    assert gone(children)
    assert not left(files)
    run = read_run(tmp_path / "bag")
    assert run.info["complete"] == "false"
    if name != "recorder":
        assert f"the node {name} was killed by SIGKILL" in run.info["reason"]


def test_killed_command_takes_its_nodes_with_it(tmp_path):
    process, children = under_way(tmp_path)
    process.kill()
    process.communicate(timeout=60)
    assert gone(children)
    run = read_run(tmp_path / "bag")
    assert run.info["complete"] == "false"
    assert f"of {LONG * 1000} cycles" in run.info["reason"]


def test_killed_nurse_takes_its_nodes_with_it_and_one_line_says_so(tmp_path):
    process, children = under_way(tmp_path)
    assert [child.cmdline()[0] for child in children[1:]] == ["recorder", *reversed(STAGES)]
    assert [child.name() for child in children[1:]] == ["recorder", *reversed(STAGES)]
    children[0].kill()
    stderr = ended(process)
    assert process.returncode == 1
    assert stderr.splitlines()[-1] == (
        "fpt: the process that starts the nodes, fpt_ros.nodes.nurse, was ended"
    )
    assert gone(children)
    assert read_run(tmp_path / "bag").info["complete"] == "false"


def test_divergence(tmp_path):
    done = fpt("run", "tora", "--set", "fpt_deformer.A=0.1", "--record", tmp_path / "bag")
    assert done.returncode == 1
    assert done.stderr.splitlines()[-1] == (
        "fpt: plant_simulator: diverged at t = 0.411 s: the position of q1, 1.51003, "
        "is over its limit of 1.5 in cycle 411 (control is lost: fpt gain shows which "
        "fpt_deformer.A converges, and of which sign)"
    )
    run = read_run(tmp_path / "bag")
    assert "q1" in run.info["reason"]
    assert len(run.topics["command"].stamps) == 412


def test_transformation_out_of_its_domain(tmp_path):
    done = fpt(
        "run", "tora", "--set", "fpt_deformer.guard=false", "--set", "fpt_deformer.A=-4",
        "--record", tmp_path / "bag",
    )  # fmt: skip
    assert done.returncode == 1
    assert "fpt_deformer: diverged at t = 0.001 s: the deformed response of q" in done.stderr
    assert read_run(tmp_path / "bag").info["complete"] == "false"


def test_a_second_graph_in_the_domain_does_not_start_and_does_no_harm(tmp_path):
    process, _ = under_way(tmp_path)
    second = fpt("run", "tora")
    assert second.returncode == 1
    assert "ROS_DOMAIN_ID" in second.stderr
    with watcher() as graph:
        graph.wait_for_stamp(1.0)
    process.send_signal(signal.SIGINT)
    ended(process)
    assert process.returncode == 130
    run = read_run(tmp_path / "bag").topics["command"]
    engine = fpt_json("simulate", "tora", "--duration", 16, "--record", tmp_path / "engine")
    assert engine["complete"]
    truth = read_run(tmp_path / "engine").topics["command"]
    count = min(len(run.stamps), len(truth.stamps))
    assert (run.vectors["effort"][:count] == truth.vectors["effort"][:count]).all()
