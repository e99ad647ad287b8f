"""Real time at 1 kHz: missed deadlines, and the latency from sensor to command.

Both are what the plant says about itself on /diagnostics, once a second, in the recording: the
median, p99 and largest latency of each second. A miss is a cycle that ended without its command.
The ratio is that of the separate processes to the composed ones.
"""

import statistics
import tempfile
from pathlib import Path

from measure import arguments, show


def measure(seconds: float, composed: bool) -> dict[str, float]:
    """One run of TORA on the wall clock, recorded."""
    from mcap.reader import make_reader
    from rosbags.typesys import Stores, get_typestore

    from fpt_ros.loop.experiment import load
    from fpt_ros.nodes import graph

    experiment = load("tora").with_values("plant_simulator", duration=seconds)
    store = get_typestore(Stores.ROS2_JAZZY)
    found: dict[str, list[float]] = {}
    with tempfile.TemporaryDirectory(prefix="fpt-bench-") as folder:
        bag = Path(folder) / "bag"
        graph.run(experiment, bag, composed=composed, realtime=True)
        for path in bag.glob("*.mcap"):
            with path.open("rb") as stream:
                for _, _, message in make_reader(stream).iter_messages(["/diagnostics"]):
                    array = store.deserialize_cdr(
                        message.data, "diagnostic_msgs/msg/DiagnosticArray"
                    )
                    for status in array.status:
                        for pair in status.values:
                            if pair.key.startswith(("deadline", "latency")):
                                found.setdefault(pair.key, []).append(float(pair.value))
    if "latency median [ms]" not in found:
        raise RuntimeError("the recording has no latencies: run for two seconds at least")
    return {
        "missed [%]": 100.0 * found["deadline misses"][-1] / (seconds / 0.001),
        "median [ms]": statistics.median(found["latency median [ms]"]),
        "p99 [ms]": statistics.median(found["latency p99 [ms]"]),
        "max [ms]": max(found["latency max [ms]"]),
    }


def main() -> None:
    """Measure, and print the table."""
    options = arguments(__doc__ or "", seconds=60.0)
    kinds = {"composed": True, "separate": False}
    runs: dict[str, list[dict[str, float]]] = {name: [] for name in kinds}
    for _ in range(options.runs):
        for name, composed in kinds.items():
            runs[name].append(measure(options.seconds, composed))
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
    main()
