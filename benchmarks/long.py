"""A run of hours: the whole command against a C loop of the same cycles that keeps nothing.

``fpt simulate tora`` with metrics, from its start to its end, and its largest memory; the C loop
(``c/tora.c``, -O2) writes all its messages into one row. At 20,721 s the beam
comes to its singularity, in the engine as in C: shorter runs only.
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
    options = arguments(__doc__ or "", duration=20_000.0)
    cycles = round(options.duration / 1e-3)

    def command() -> float:
        started = perf_counter()
        words = [FPT, "simulate", "tora", "--duration", str(options.duration), "--json"]
        done = subprocess.run(words, check=True, capture_output=True, text=True)
        assert json.loads(done.stdout)["cycles"] == cycles
        return perf_counter() - started

    with tempfile.TemporaryDirectory(prefix="fpt-bench-") as folder:
        run = c_loop("tora", Path(folder), "-DNOTHING_KEPT")
        rows = rows_like(engine_of("tora", 1), 1)

        measurements = {
            "C, -O2, nothing kept": lambda: cycles / run_c(run, rows, cycles),
            "fpt simulate tora": command,
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
