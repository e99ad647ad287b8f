"""Running the command ``fpt`` as its users do: a process, its exit status and what it prints."""

import json
import os
import signal
import subprocess
import sys
import tempfile
from contextlib import suppress
from functools import cache
from pathlib import Path

import psutil

BIN = Path(sys.executable).parent
TIMEOUT = 120.0


def fpt(*arguments, timeout=TIMEOUT, cwd=None):
    return subprocess.run(
        [BIN / "fpt", *map(str, arguments)],
        capture_output=True,
        text=True,
        timeout=timeout,
        cwd=cwd,
        check=False,
    )


def fpt_json(*arguments, **options):
    done = fpt(*arguments, "--json", **options)
    assert done.returncode == 0, done.stderr + done.stdout
    return json.loads(done.stdout)


OSCILLATOR = ("vdp_second_order", "--variant", "nonadaptive")
"""For graphs on the wall clock: it bears any late command. A busy machine lets commands stay away
for half a second, and TORA is lost then."""

STARTED = []
"""By the test that runs: a test that fails must not leave its graph to the next one's domain."""


def start_fpt(*arguments):
    process = subprocess.Popen(
        [BIN / "fpt", *map(str, arguments)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    STARTED.append(process)
    return process


def end_started():
    """End what the test left running; how each has ended, and what the test has not read of it."""
    ends = []
    while STARTED:
        process = STARTED.pop()
        how = "was still running" if process.poll() is None else f"ended ({process.returncode})"
        if process.returncode is None:
            process.terminate()
        if process.stderr.closed:  # the test has read it
            process.wait(timeout=TIMEOUT)
            continue
        try:
            _, stderr = process.communicate(timeout=TIMEOUT)
        except subprocess.TimeoutExpired:
            process.kill()
            _, stderr = process.communicate()
        ends.append(f"{' '.join(map(str, process.args[1:]))} {how} and wrote:\n{stderr}")
    return "\n".join(ends)


def node_if_any(process, name):
    """The process of a node of a ``fpt run``."""
    for child in psutil.Process(process.pid).children(recursive=True):
        with suppress(psutil.NoSuchProcess):
            if child.cmdline()[:1] == [name]:
                return child
    return None


def node_of(process, name):
    found = node_if_any(process, name)
    assert found is not None, name
    return found


@cache
def _fork_server():
    """One for all tests of this process; it ends with it, as its input ends."""
    return subprocess.Popen(
        [sys.executable, Path(__file__).with_name("fork_server.py")],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )


def forked_fpt(*arguments, cwd=None):
    """As :func:`fpt`, without the second that importing takes: for the many tests of messages."""
    server = _fork_server()
    with tempfile.TemporaryDirectory() as folder:
        stdout, stderr = Path(folder) / "stdout", Path(folder) / "stderr"
        request = {
            "arguments": [*map(str, arguments)],
            "cwd": str(cwd or Path.cwd()),
            "environment": dict(os.environ),
            "stdout": str(stdout),
            "stderr": str(stderr),
        }
        try:
            server.stdin.write(json.dumps(request) + "\n")
            server.stdin.flush()
            status = int(server.stdout.readline())
        except BaseException:  # a test's time is over: its answer must not be the next one's
            os.killpg(server.pid, signal.SIGKILL)
            _fork_server.cache_clear()
            raise
        return subprocess.CompletedProcess(
            request["arguments"], status, stdout.read_text(), stderr.read_text()
        )


def forked_fpt_json(*arguments, **options):
    done = forked_fpt(*arguments, "--json", **options)
    assert done.returncode == 0, done.stderr + done.stdout
    return json.loads(done.stdout)
