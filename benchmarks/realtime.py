"""Real time at 1 kHz: missed deadlines, and the latency from sensor to command.

Both are what the plant says about itself on /diagnostics: the distribution over the whole run. A
miss is a cycle that ended without its command. Without a recorder, and with one. What the machine
itself does is measured in the same run: how late a bare loop that sleeps until every millisecond
wakes up; a miss is there a lateness of more than a cycle's slack.
"""

import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from dataclasses import asdict
from pathlib import Path

from measure import arguments, show

from fpt_ros.runs.latency import Latencies

BARE = "a bare loop that sleeps"
KINDS = {
    "composed": (True, False),
    "composed, recorded": (True, True),
    "separate": (False, False),
    "separate, recorded": (False, True),
}


SLACK = 0.8e-3
"""Of a composed cycle of 1 ms [s], whose work is done in less than 0.2 ms."""


def bare_loop(seconds: float) -> dict[str, float]:
    """How late a loop wakes that does nothing but sleep until the next millisecond."""
    lateness, due = [], time.monotonic()
    for _ in range(round(seconds / 0.001)):
        due += 0.001
        time.sleep(max(0.0, due - time.monotonic()))
        lateness.append(time.monotonic() - due)
    lateness.sort()
    return {
        "missed [%]": 100.0 * sum(late > SLACK for late in lateness) / len(lateness),
        "median [ms]": 1e3 * lateness[len(lateness) // 2],
        "p99 [ms]": 1e3 * lateness[int(0.99 * len(lateness))],
        "max [ms]": 1e3 * lateness[-1],
    }


def listen() -> None:
    """Process that prints what the plant said last, when its standard input is closed."""
    import rclpy
    from diagnostic_msgs.msg import DiagnosticArray

    from fpt_ros.bags.diagnostics import latencies

    found: list[Latencies] = []

    def on_message(data: bytes) -> None:
        told = latencies(data, "plant_simulator")
        if told is not None:
            found[:] = [told]

    rclpy.init()
    node = rclpy.create_node("listener")
    node.create_subscription(DiagnosticArray, "/diagnostics", on_message, 100, raw=True)
    print("up", flush=True)
    os.set_blocking(sys.stdin.fileno(), False)
    while sys.stdin.buffer.raw.read(1) is None:  # type: ignore[attr-defined]  # b"": closed
        rclpy.spin_once(node, timeout_sec=0.5)
    print(json.dumps(asdict(found[0])) if found else "", flush=True)


def run(seconds: float, composed: bool, bag: Path | None) -> Latencies:
    """One run of TORA on the wall clock, and what its plant said last."""
    from fpt_ros.experiments.experiment import load
    from fpt_ros.nodes import child, graph
    from fpt_ros.nodes.nursery import Nursery

    experiment = load("tora").with_values("plant_simulator", duration=seconds)
    pipe = subprocess.PIPE
    listener = subprocess.Popen(
        [sys.executable, __file__, "listen"],
        stdin=pipe,
        stdout=pipe,
        env=dict(child.environment()),
        text=True,
    )
    assert listener.stdout is not None
    try:
        listener.stdout.readline()
        with Nursery() as nursery:
            graph.run(nursery, experiment, bag, composed=composed, realtime=True)
        said, _ = listener.communicate(timeout=30)
    finally:
        listener.kill()
        listener.wait()
    if not said.strip():
        raise RuntimeError("nothing was heard on /diagnostics")
    return Latencies(**json.loads(said))


def measure(seconds: float, composed: bool, recorded: bool) -> dict[str, float]:
    """Misses and latencies of one run."""
    with tempfile.TemporaryDirectory(prefix="fpt-bench-") as folder:
        told = run(seconds, composed, Path(folder) / "bag" if recorded else None)
    return {
        "missed [%]": 100.0 * told.missed / told.cycles,
        "median [ms]": 1e3 * told.quantile(0.5),
        "p99 [ms]": 1e3 * told.quantile(0.99),
        "max [ms]": 1e3 * told.largest,
    }


def main() -> None:
    """Measure, and print the table."""
    options = arguments(__doc__ or "", seconds=60.0)
    runs: dict[str, list[dict[str, float]]] = {name: [] for name in (BARE, *KINDS)}
    for _ in range(options.runs):
        runs[BARE].append(bare_loop(options.seconds))
        for name, how in KINDS.items():
            runs[name].append(measure(options.seconds, *how))
    found = {
        name: {key: statistics.median([run[key] for run in each]) for key in each[0]}
        for name, each in runs.items()
    }
    base = found["composed"]["median [ms]"]
    rows = [
        {"tora --realtime": name, **values, "median, ratio": values["median [ms]"] / base}
        for name, values in found.items()
    ]
    show(f"Real time, 1 kHz for {options.seconds:g} s", rows, options.json)


if __name__ == "__main__":
    if sys.argv[1:2] == ["listen"]:
        listen()
    else:
        main()
