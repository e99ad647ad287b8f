"""Sweeps: runs a second with one worker and with two, and what a run costs as sweeps grow.

TORA, 16 s a run, through the pool of ``fpt sweep``. Workers are started and have read the
experiment before the clock runs, as a sweep of any length does that once.
"""

import tempfile
from collections.abc import Callable
from pathlib import Path
from time import perf_counter

from measure import alternate, arguments, median, show

from fpt_ros.sweep.executor import LocalPool
from fpt_ros.sweep.run_one import run_chunk
from fpt_ros.sweep.sweep import Sweep, define, open_directory, run


def tora(count: int) -> Sweep:
    """Some gains between weak and strong."""
    return define("tora", "adaptive", (), None, [f"fpt_deformer.A=-0.1:-4:{count}"], None, 0, ())


def rate(count: int, workers: int) -> float:
    """Runs a second of a whole sweep, without the start of the workers."""
    sweep = tora(count)
    with tempfile.TemporaryDirectory(prefix="fpt-bench-") as folder, LocalPool(workers) as pool:
        for future in [pool.submit(run_chunk, sweep.job, [0] * 20) for _ in range(4 * workers)]:
            future.result()
        directory = Path(folder) / "sweep"
        open_directory(sweep, directory)
        started = perf_counter()
        run(sweep, directory, pool, lambda done, lost: None).close()
        return count / (perf_counter() - started)


def main() -> None:
    """Measure, and print the table."""
    options = arguments(__doc__ or "", short=100, count=1000)
    cases = [(options.count, 1), (options.count, 2), (options.short, 2)]

    def case(count: int, workers: int) -> Callable[[], float]:
        return lambda: rate(count, workers)

    names = {f"{count:,} runs, {workers} worker(s)": (count, workers) for count, workers in cases}
    found = median(
        alternate({name: case(*at) for name, at in names.items()}, options.runs, options.json)
    )
    first, second, _ = found.values()
    rows = [
        {
            "what": name,
            "runs/s": value,
            "ms a run and worker": 1e3 * names[name][1] / value,
            "ratio to one worker": value / first,
            f"cost against {options.count:,} runs": second / value if names[name][1] == 2 else None,
        }
        for name, value in found.items()
    ]
    show("Sweep, tora, 16 s a run", rows, options.json)


if __name__ == "__main__":
    main()
