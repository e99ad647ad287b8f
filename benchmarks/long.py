"""A run of hours: the whole command against a C loop of the same cycles that keeps nothing.

``fpt simulate`` with metrics, from its start to its end, and its largest memory; the C loop
(``c/``, -O2) writes all its messages into one row. TORA comes to its singularity at 20,721 s, in
the engine as in C; ``--experiment vdp_rfpt --duration 36000`` goes on.
"""

import json
import resource
import subprocess
import sys
import tempfile
from pathlib import Path
from time import perf_counter

from engine import c_loop, engine_of, rows_like, run_c
from measure import alternate, arguments, median, show

FPT = str(Path(sys.executable).with_name("fpt"))


def main() -> None:
    """Measure, and print the table."""
    options = arguments(__doc__ or "", experiment="tora", duration=20_000.0)
    name = options.experiment
    one = engine_of(name, 1)
    cycles = round(options.duration / one._loop.plant.dt)

    def command() -> float:
        started = perf_counter()
        words = [FPT, "simulate", name, "--duration", str(options.duration), "--json"]
        done = subprocess.run(words, check=True, capture_output=True, text=True)
        assert json.loads(done.stdout)["cycles"] == cycles
        return perf_counter() - started

    with tempfile.TemporaryDirectory(prefix="fpt-bench-") as folder:
        run = c_loop(name, Path(folder), "-DNOTHING_KEPT")
        rows = rows_like(one, 1)

        measurements = {
            "C, -O2, nothing kept": lambda: cycles / run_c(run, rows, cycles),
            f"fpt simulate {name}": command,
        }
        found = median(alternate(measurements, options.runs, options.json))
    base = found["C, -O2, nothing kept"]
    largest = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
    table = [
        {
            "what": what,
            "time [s]": took,
            "ratio to C": took / base,
            "memory [MB]": largest if what.startswith("fpt") else None,
        }
        for what, took in found.items()
    ]
    show(f"{cycles:,} cycles", table, options.json)


if __name__ == "__main__":
    main()
