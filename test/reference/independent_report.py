"""What the second programs print: settled rms of the tracking errors beside the known figures.

Usage of each: python independent_NAME.py [reference.json]
"""

from __future__ import annotations

import json
import sys
import time
from pathlib import Path

import numpy as np


def settled_rms(record: dict, settle: float) -> dict[str, float]:
    """Root mean square of the errors from `settle` on, by coordinate."""
    late = record["t"] >= settle - 1e-9
    values = np.sqrt(np.mean(record["e"][late] ** 2, axis=0)) if late.any() else [np.nan] * 9
    return {name: float(value) for name, value in zip(record["names"], values, strict=False)}


def chatter(record: dict, start: float = 0.0) -> float:
    """Mean of the norm of r_k - r_{k-1}, over the cycles k >= 1 from `start` on."""
    steps = np.diff(record["r"], axis=0)
    used = ~np.isnan(steps).all(axis=1) & (record["t"][1:] >= start - 1e-9)
    return float(np.mean(np.sqrt(np.nansum(steps[used] ** 2, axis=1))))


def report(name: str, run, variants, settle: float) -> None:
    """Run all variants and print one line for each."""
    known = {}
    if len(sys.argv) > 1:
        rows = json.loads(Path(sys.argv[1]).read_text())
        known = {r["variant"] or "adaptive": r for r in rows if r["experiment"] == name}
    for variant in variants:
        started = time.perf_counter()
        record = run(variant)
        elapsed = time.perf_counter() - started
        for coordinate, rms in settled_rms(record, settle).items():
            line = f"{name} {variant} {coordinate} {rms:.12g}"
            if variant in known:
                expected = known[variant]["rms_settled"][coordinate]
                ratio = rms / expected - 1.0
                good = abs(ratio) <= known[variant]["rtol"]
                line += f"  reference {expected:.12g} ({ratio:+.1e} {'ok' if good else 'DIFFERS'})"
            print(line)
        lost = f", diverged at {record['diverged']:.4f} s" if record.get("diverged") else ""
        print(f"    chatter {chatter(record):.6g}{lost} [{elapsed:.1f} s]")
