"""Real time at 1 kHz: missed deadlines, and the latency from sensor to command.

Both are what the plant says about itself on /diagnostics, in the recording: the distribution over
the whole run. A miss is a cycle that ended without its command. The ratio is that of the separate
processes to the composed ones.
"""

import statistics
import tempfile
from pathlib import Path

from measure import arguments, show


def measure(seconds: float, composed: bool) -> dict[str, float]:
    """One run of TORA on the wall clock, recorded."""
    from fpt_ros.bags.reader import read_run
    from fpt_ros.loop.experiment import load
    from fpt_ros.nodes import graph

    experiment = load("tora").with_values("plant_simulator", duration=seconds)
    with tempfile.TemporaryDirectory(prefix="fpt-bench-") as folder:
        bag = Path(folder) / "bag"
        graph.run(experiment, bag, composed=composed, realtime=True)
        told = read_run(bag).latency
    if told is None:
        raise RuntimeError("the recording has no latencies")
    return {
        "missed [%]": 100.0 * told.missed / told.cycles,
        "median [ms]": 1e3 * told.quantile(0.5),
        "p99 [ms]": 1e3 * told.quantile(0.99),
        "max [ms]": 1e3 * told.largest,
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
