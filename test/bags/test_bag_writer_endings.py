"""How a recording ends: refused, closed, on a full disk, killed."""

import contextlib
import resource
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
import samples

from fpt_ros.bags import reader
from fpt_ros.bags.writer import BagWriter
from fpt_ros.errors import BadInput, RunFailed
from fpt_ros.messages.cdr import Codec
from fpt_ros.messages.frames import JointStates
from fpt_ros.messages.topics import JOINT_STATE, JOINT_STATES

MESSAGE = Codec(JOINT_STATES).encode(JointStates(0, ("a",), (1.0,), (2.0,), (3.0,)))


def test_unknown_type_is_refused(tmp_path: Path) -> None:
    with (
        pytest.raises(BadInput, match="cannot record 'my_msgs/msg/Mine': it has to be"),
        BagWriter(tmp_path / "bag", {}, {}) as bag,
    ):
        bag.write("/mine", "my_msgs/msg/Mine", 0, b"")


@pytest.mark.parametrize("what", ["directory", "file", "dangling"])
def test_does_not_overwrite(tmp_path: Path, what: str) -> None:
    path = tmp_path / "bag"
    if what == "directory":
        path.mkdir()
    elif what == "file":
        path.touch()
    else:
        path.symlink_to(tmp_path / "nowhere")
    with pytest.raises(BadInput, match="exists: recordings do not overwrite") as error:
        BagWriter(path, {}, {})
    assert "\n" not in str(error.value)


def test_parent_that_cannot_be_written(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(BadInput, match="cannot be created: Not a directory"):
        BagWriter(tmp_path / "file" / "bag", {}, {})
    with pytest.raises(BadInput, match="cannot be created: "):
        BagWriter(Path("/proc/bag"), {}, {})


def test_name_too_long_leaves_nothing(tmp_path: Path) -> None:
    with pytest.raises(BadInput, match="cannot be created: File name too long"):
        BagWriter(tmp_path / ("n" * 255), {}, {})
    assert list(tmp_path.iterdir()) == []


def test_closing_twice_and_writing_after(tmp_path: Path) -> None:
    bag = BagWriter(tmp_path / "bag", {}, {})
    bag.close("first")
    bag.close("second")
    assert reader.info(tmp_path / "bag")["reason"] == "first"
    with pytest.raises(RunFailed, match="is closed"):
        bag.write("/joint_states", JOINT_STATE, 0, MESSAGE)


@pytest.mark.parametrize(
    ("error", "reason"),
    [(RunFailed("it broke"), "it broke"), (KeyboardInterrupt(), "interrupted")],
)
def test_exception_is_the_reason(tmp_path: Path, error: BaseException, reason: str) -> None:
    def fail() -> None:
        with BagWriter(tmp_path / "bag", {}, {}) as bag:
            bag.write("/joint_states", JOINT_STATE, 5, MESSAGE)
            raise error

    with pytest.raises(type(error)):
        fail()
    run = reader.read_run(tmp_path / "bag")
    assert (run.info["complete"], run.info["reason"]) == ("false", reason)
    # a message without a stamp has the recorder's
    assert list(run.topics["joint_states"].stamps) == [5]


@contextlib.contextmanager
def file_size_limit(size: int) -> Iterator[None]:
    """No file may grow beyond ``size`` bytes: what a full disk does, for this process."""
    old = resource.getrlimit(resource.RLIMIT_FSIZE)
    handler = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, old[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, old)
        signal.signal(signal.SIGXFSZ, handler)


def test_disk_full_is_one_line_and_leaves_whole_records(tmp_path: Path) -> None:
    written = 0
    bag = BagWriter(tmp_path / "bag", {}, {})

    def fill() -> None:
        nonlocal written
        for stamp, value in enumerate(np.random.default_rng(0).random(100_000)):
            frame = JointStates(stamp, ("a",), (float(value),), (), ())
            bag.write("/joint_states", JOINT_STATE, stamp, codec.encode(frame))
            written += 1

    codec = Codec(JOINT_STATES)
    with file_size_limit(400_000), pytest.raises(RunFailed, match="cannot be written: ") as error:
        fill()
    assert "\n" not in str(error.value)
    bag.close()
    with pytest.raises(RunFailed, match="is closed"):
        bag.write("/joint_states", JOINT_STATE, 0, MESSAGE)
    about = reader.info(tmp_path / "bag")
    assert (about["complete"], about["reason"]) == (False, "the recording was cut")
    assert 0 < about["messages"] <= written + 1  # the last one may be in the file all the same


WRITE_UNTIL_KILLED = """
import sys
from pathlib import Path
from fpt_ros.bags.writer import BagWriter
from fpt_ros.messages.cdr import Codec
from fpt_ros.messages.frames import JointStates
from fpt_ros.messages.topics import JOINT_STATES

codec = Codec(JOINT_STATES)
with BagWriter(Path(sys.argv[1]), {}, {}) as bag:
    for cycle in range(10**9):
        frame = JointStates(cycle, ("a",), (float(cycle),), (0.0,), (0.0,))
        bag.write("/joint_states", JOINT_STATES.type, cycle, codec.encode(frame))
        if cycle == 10_000:
            print("running", flush=True)
"""


@pytest.mark.parametrize("attempt", range(4 if samples.whole else 2))
def test_killed_at_any_moment(tmp_path: Path, attempt: int) -> None:
    command = [sys.executable, "-c", WRITE_UNTIL_KILLED, str(tmp_path / "bag")]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == b"running\n"
        process.kill()
        process.wait(timeout=60)
    run = reader.read_run(tmp_path / "bag")
    series = run.topics["joint_states"]
    assert np.array_equal(series.column("position", "a"), np.arange(len(series.stamps)))
    assert run.info["complete"] == "false"
    assert run.info["reason"] == "the recording was cut"


def test_a_slow_run_is_in_the_file_within_a_second(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    now = 100.0
    monkeypatch.setattr("fpt_ros.bags.writer.monotonic", lambda: now)
    bag = BagWriter(tmp_path / "bag", {}, {})
    for second in range(3):
        now = 100.0 + 1.1 * second
        bag.write("/joint_states", JOINT_STATE, second, MESSAGE)
    assert reader.info(tmp_path / "bag")["messages"] == 3
    bag.write("/joint_states", JOINT_STATE, 3, MESSAGE)
    assert reader.info(tmp_path / "bag")["messages"] == 3
    bag.flush()
    assert reader.info(tmp_path / "bag")["messages"] == 4
    bag.close()
