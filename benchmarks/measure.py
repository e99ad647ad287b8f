"""What the benchmarks share: the machine, alternating runs and their medians, the table."""

import argparse
import json
import os
import platform
import random
import statistics
from collections.abc import Callable, Mapping, Sequence
from datetime import date
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.table import Table

WIDTH = 132
"""Least width of a table [columns]: narrower it would be cut where there is no terminal."""


def machine() -> dict[str, Any]:
    """Where and when: printed with every table."""
    model = platform.machine()
    for line in Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            model = line.partition(":")[2].strip()
            break
    return {
        "date": date.today().isoformat(),
        "cpu": model,
        "cores": len(os.sched_getaffinity(0)),
        "load": round(os.getloadavg()[0], 2),
        "python": platform.python_version(),
        "system": f"{platform.system()} {platform.release()}",
    }


def arguments(about: str, **options: Any) -> argparse.Namespace:
    """Command line: ``--runs``, ``--json`` and the options given (name=default)."""
    parser = argparse.ArgumentParser(description=about.strip().splitlines()[0])
    parser.add_argument("--runs", type=int, default=5, help="alternating runs; medians are shown")
    parser.add_argument("--json", action="store_true", help="one JSON object instead of a table")
    for name, default in options.items():
        kind = type(default)
        parser.add_argument(f"--{name}", type=kind, default=default, help=f"default {default}")
    return parser.parse_args()


def alternate(
    measurements: Mapping[str, Callable[[], float]], runs: int, quiet: bool
) -> dict[str, list[float]]:
    """Run all measurements in turn, in random order, ``runs`` times: load meets all alike."""
    results: dict[str, list[float]] = {name: [] for name in measurements}
    console = Console(stderr=True, quiet=quiet)
    for run in range(runs):
        for name in random.sample(list(measurements), len(measurements)):
            results[name].append(measurements[name]())
            console.print(f"run {run + 1} of {runs}: {name}: {results[name][-1]:.5g}", style="dim")
    return results


def median(results: Mapping[str, Sequence[float]]) -> dict[str, float]:
    """The median of each measurement."""
    return {name: statistics.median(values) for name, values in results.items()}


def show(title: str, rows: Sequence[Mapping[str, Any]], as_json: bool) -> None:
    """One table, or one JSON object, of rows with the same keys."""
    where = machine()
    if as_json:
        print(json.dumps({"title": title, "machine": where, "rows": list(rows)}))
        return
    caption = (
        f"{where['date']}, {where['cpu']}, {where['cores']} cores, load {where['load']}, "
        f"Python {where['python']}"
    )
    table = Table(title=title, caption=caption)
    for i, key in enumerate(rows[0]):
        table.add_column(key, justify="left" if i == 0 else "right")
    for row in rows:
        table.add_row(*[_text(value) for value in row.values()])
    screen = Console()
    Console(width=max(screen.width, WIDTH)).print(table)


def _text(value: Any) -> str:
    if value is None:
        return ""
    if isinstance(value, float):
        return f"{value:,.0f}" if abs(value) >= 1000 else f"{value:.3g}"
    return str(value)
