"""How long things take to start: commands from a cold shell, a graph, and a node until it is ready.

The ratio is to a Python that imports numpy and nothing else, started in the same run. A node is
ready when it has been set up and waits for its messages.
"""

import os
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from pathlib import Path
from time import monotonic, sleep

from measure import alternate, arguments, median, show

FPT = str(Path(sys.executable).with_name("fpt"))
SHORT_RUN = [FPT, "run", "tora", "--duration", "0.05"]
READY_PROBE = """
import os, sys
from fpt_ros.nodes import loop_node, spin
def ready(nodes, stopped, context):
    os.write(1, b"ready\\n")
    return original(nodes, stopped, context)
original = spin.spin
spin.spin = ready
from fpt_ros.nodes import process
process.spin = ready
from fpt_ros.nodes.denoiser import main
main()
"""


def seconds(command: list[str], environment: Mapping[str, str] | None = None) -> float:
    """Wall time of a command [s]."""
    started = monotonic()
    everything = {**os.environ, **(environment or {})}
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, env=everything)
    return monotonic() - started


def first_start() -> float:
    """Of ``fpt simulate tora`` with nothing compiled yet."""
    with tempfile.TemporaryDirectory(prefix="fpt-bench-") as cache:
        return seconds([FPT, "simulate", "tora"], {"XDG_CACHE_HOME": cache})


def node() -> tuple[float, float]:
    """Seconds until a node is set up and waits for messages, and its resident memory [MB]."""
    with tempfile.TemporaryDirectory(prefix="fpt-bench-") as folder:
        from fpt_ros.experiments.experiment import load

        parameters = Path(folder) / "parameters.yaml"
        load("tora").write(parameters)
        started = monotonic()
        child = subprocess.Popen(
            [sys.executable, "-c", READY_PROBE, "--ros-args", "--params-file", str(parameters)],
            stdout=subprocess.PIPE,
            env={**os.environ, "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"},
        )
        try:
            assert child.stdout is not None
            if child.stdout.readline() != b"ready\n":
                raise RuntimeError("the node has not started")
            ready = monotonic() - started
            sleep(1.0)  # discovery takes memory too
            status = Path(f"/proc/{child.pid}/status").read_text()
        finally:
            child.terminate()
            child.wait()
    (resident,) = [line for line in status.splitlines() if line.startswith("VmRSS")]
    return ready, int(resident.split()[1]) / 1024


def main() -> None:
    """Measure, and print the table."""
    options = arguments(__doc__ or "")
    seconds([FPT, "simulate", "tora"])  # the code is cached from here on
    base = "python, import numpy"
    found = median(
        alternate(
            {
                base: lambda: seconds([sys.executable, "-c", "import numpy"]),
                "fpt --help": lambda: seconds([FPT, "--help"]),
                "fpt simulate tora, code cached": lambda: seconds([FPT, "simulate", "tora"]),
                "fpt simulate tora, first start ever": first_start,
                "fpt run tora, of 50 cycles": lambda: seconds(SHORT_RUN),
                "a node until ready": lambda: node()[0],
            },
            options.runs,
            options.json,
        )
    )
    rows: list[dict[str, float | str | None]] = [
        {"what": name, "seconds": took, "ratio": took / found[base], "resident [MB]": None}
        for name, took in found.items()
    ]
    rows[-1]["resident [MB]"] = node()[1]
    show("Starting", rows, options.json)


if __name__ == "__main__":
    main()
