"""The report of a long recording: the whole command, against reading the messages with mcap alone.

``fpt report`` of a bag of so many messages of TORA, from its start to its end, with its largest
memory and the size of the page; beside it one pass of the ``mcap`` package over the same file,
which takes every message out of its chunk and decodes none.
"""

import subprocess
import sys
import tempfile
from pathlib import Path
from time import perf_counter

from mcap.reader import make_reader
from measure import alternate, arguments, median, show

FPT = str(Path(sys.executable).with_name("fpt"))

TOPICS = 4
"""Messages of a cycle: TORA has no tuner."""

DT = 1e-3


def main() -> None:
    """Measure, and print the table."""
    options = arguments(__doc__ or "", messages=1_000_000)
    with tempfile.TemporaryDirectory(prefix="fpt-bench-") as folder:
        bag, page = Path(folder) / "bag", Path(folder) / "report" / "index.html"
        words = [FPT, "simulate", "tora", "--duration", str(options.messages / TOPICS * DT)]
        subprocess.run([*words, "--record", bag], check=True, capture_output=True)
        peaks: list[float] = []

        def report() -> float:
            started = perf_counter()
            peaks.append(_memory([FPT, "report", str(bag), "--out", str(page.parent)]))
            return perf_counter() - started

        def read() -> float:
            started = perf_counter()
            with next(bag.glob("*.mcap")).open("rb") as file:
                count = sum(1 for _ in make_reader(file).iter_messages())
            assert count == options.messages
            return perf_counter() - started

        measured = {"mcap, messages as bytes": read, "fpt report": report}
        found = median(alternate(measured, options.runs, options.json))
        size = page.stat().st_size
    base = found["mcap, messages as bytes"]
    rows = [
        {
            "what": what,
            "time [s]": took,
            "ratio": took / base,
            "memory [MB]": max(peaks) if what == "fpt report" else None,
            "page [MB]": size / 1e6 if what == "fpt report" else None,
        }
        for what, took in found.items()
    ]
    show(f"Report of {options.messages:,} messages", rows, options.json)


def _memory(command: list[str]) -> float:
    """Run a command; its largest memory [MB]."""
    watch = "import resource, subprocess, sys; subprocess.run(sys.argv[1:], check=True, "
    watch += "stdout=subprocess.DEVNULL); "
    watch += "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)"
    done = subprocess.run(
        [sys.executable, "-c", watch, *command], check=True, capture_output=True, text=True
    )
    return int(done.stdout) / 1024


if __name__ == "__main__":
    main()
