"""Sweeps: runs a second with one worker and with two, and what a run costs as sweeps grow.

TORA, 16 s a run, through the pool of ``fpt sweep``. Workers are started and have read the
experiment before the clock runs, as a sweep of any length does that once. What a run costs is CPU
time, of the workers and of the master: other users of the machine change it less than the rate. How
much two processes can do at all here, beside one, is measured by loops that only count; a worker is
idle where it neither runs nor waits for a core.
"""

import statistics
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter, process_time

from measure import arguments, show

from fpt_ros.sweep.definition import Sweep, define
from fpt_ros.sweep.directory import open_directory
from fpt_ros.sweep.executor import LocalPool
from fpt_ros.sweep.run_one import run_chunk
from fpt_ros.sweep.sweep import run

COUNTED = 1.0
"""Seconds for which the loops count."""


@dataclass(frozen=True)
class Measured:
    """One sweep.

    Attributes:
        rate: runs a second.
        worker, master: CPU time of a run [ms].
        idle: part of the time in which a worker had nothing to do [%].
        resident: memory of the master when all runs are made [MB].
    """

    rate: float
    worker: float
    master: float
    idle: float
    resident: float


def tora(count: int) -> Sweep:
    """Some gains between weak and strong."""
    return define("tora", "adaptive", (), None, [f"fpt_deformer.A=-0.1:-4:{count}"], None, 0, ())


def times(pool: LocalPool) -> tuple[float, float]:
    """Time that a pool's workers have run so far, and waited for a core [s]."""
    read = [Path(f"/proc/{pid}/schedstat").read_text().split() for pid in pool.pids]
    return sum(int(each[0]) for each in read) / 1e9, sum(int(each[1]) for each in read) / 1e9


def resident() -> float:
    """Memory of this process [MB]."""
    status = Path("/proc/self/status").read_text().splitlines()
    (line,) = [line for line in status if line.startswith("VmRSS")]
    return int(line.split()[1]) / 1024


def measure(count: int, workers: int) -> Measured:
    """A whole sweep, without the start of the workers."""
    sweep = tora(count)
    with tempfile.TemporaryDirectory(prefix="fpt-bench-") as folder, LocalPool(workers) as pool:
        for future in [pool.submit(run_chunk, sweep.job, [0] * 20) for _ in range(4 * workers)]:
            future.result()
        directory = Path(folder) / "sweep"
        open_directory(sweep.definition, directory)
        before, own, started = times(pool), process_time(), perf_counter()
        run(sweep, directory, pool, lambda done, lost: None).close()
        took, master = perf_counter() - started, process_time() - own
        ran, waited = (b - a for a, b in zip(before, times(pool), strict=True))
    idle = 100.0 * (1.0 - (ran + waited) / (took * workers))
    return Measured(count / took, 1e3 * ran / count, 1e3 * master / count, idle, resident())


def counting(end: float) -> int:
    """How far a process counts until a moment of the wall clock."""
    number = 0
    while time.time() < end:
        number += 1
    return number


def machine(workers: int) -> float:
    """How far processes count together [1/s]."""
    with LocalPool(workers) as pool:
        for future in [pool.submit(counting, time.time() + 0.3) for _ in range(workers)]:
            future.result()
        end = time.time() + COUNTED
        counted = [pool.submit(counting, end) for _ in range(workers)]
        return sum(future.result() for future in counted) / COUNTED


def main() -> None:
    """Measure, and print the table."""
    options = arguments(__doc__ or "", short=100, count=1000)
    cases = [(options.short, 1), (options.count, 1), (options.short, 2), (options.count, 2)]
    found: dict[tuple[int, int], list[Measured]] = {case: [] for case in cases}
    gain, sweep_gain = [], []
    for _ in range(options.runs):
        for case in cases:
            found[case].append(measure(*case))
        gain.append(machine(2) / machine(1))
        sweep_gain.append(found[cases[3]][-1].rate / found[cases[1]][-1].rate)

    def median(case: tuple[int, int], what: str) -> float:
        return statistics.median(getattr(one, what) for one in found[case])

    rows = []
    for count, workers in cases:
        case, short = (count, workers), (options.short, workers)
        rows.append(
            {
                "what": f"{count:,} runs, {workers} worker(s)",
                "runs/s": median(case, "rate"),
                "CPU of a run [ms]": median(case, "worker"),
                "of the master [ms]": median(case, "master"),
                "idle [%]": median(case, "idle"),
                f"CPU against {options.short:,} runs": median(case, "worker")
                / median(short, "worker"),
                "rate, two workers to one": statistics.median(sweep_gain)
                if case == cases[3]
                else None,
                "counting, two to one": statistics.median(gain) if case == cases[3] else None,
                "master [MB]": median(case, "resident"),
            }
        )
    show("Sweep, tora, 16 s a run", rows, options.json)


if __name__ == "__main__":
    main()
