"""Machines that are poor or wrong: refused at once with a remedy, or survived."""

import subprocess

import pytest
from command import BIN, forked_fpt, fpt

ENOUGH_TIME = 120.0


def alone(*words):
    """A command with namespaces of its own, in which one may be root."""
    return subprocess.run(
        ["unshare", "--map-root-user", *map(str, words)],
        capture_output=True,
        text=True,
        timeout=ENOUGH_TIME,
        check=False,
    )


@pytest.fixture
def may_unshare():
    done = alone("--net", "--mount", "true")
    if done.returncode:
        pytest.skip(f"no namespaces here: {done.stderr.strip()}")


@pytest.mark.parametrize("words", [("run", "tora"), ("pause",)])
def test_a_domain_that_there_is_not(monkeypatch, words):
    monkeypatch.setenv("ROS_DOMAIN_ID", "999")
    done = forked_fpt(*words)
    assert done.returncode == 2
    assert done.stderr.splitlines()[-1] == (
        "fpt: domain: ROS_DOMAIN_ID=999; ROS_DOMAIN_ID from 0 to 232"
    )


@pytest.mark.usefixtures("may_unshare")
def test_no_network_interface():
    done = alone("--net", BIN / "fpt", "run", "tora")
    assert done.returncode == 2
    assert "fpt: loopback: down; ip link set lo up" in done.stderr


@pytest.mark.usefixtures("may_unshare")
def test_a_home_that_cannot_be_written_few_files_and_no_shared_memory(tmp_path):
    """All at once, and the run is as any other."""
    script = (
        "mount -t tmpfs -o size=64k none /dev/shm && ulimit -n 64 && "
        f"exec '{BIN}/fpt' run tora --duration 0.1 --json"
    )
    done = alone("--mount", "env", "HOME=/dev/null/home", f"TMPDIR={tmp_path}", "sh", "-c", script)
    assert done.returncode == 0, done.stderr
    assert '"complete": true' in done.stdout
    assert (tmp_path / "ros_log_0").is_dir()


def test_an_unknown_home_does_not_matter_where_the_logs_have_a_place(monkeypatch, tmp_path):
    from fpt_ros.nodes.child import environment

    monkeypatch.setenv("HOME", "/dev/null/home")
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path))
    assert environment()["ROS_LOG_DIR"] == str(tmp_path)
    assert fpt("--help").returncode == 0
