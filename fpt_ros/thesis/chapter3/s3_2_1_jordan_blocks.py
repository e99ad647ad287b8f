"""Section 3.2.1, (3.9) to (3.15): complex eigenvalues and Jordan blocks of the response map."""

import numpy as np

from fpt_ros.thesis import drawings as draw
from fpt_ros.thesis.chapter3.s3_1_1_bare_iteration import sizes
from fpt_ros.thesis.claim import NO, ONLY_IF, YES, Claim, Picture, Table, Verdict
from fpt_ros.thesis.measures import complete
from fpt_ros.thesis.setup import Runs, Setup

MAP = "affine_map"
SLOPE = 0.6327268
"""F'(x*) of K = 0.5, D = 0.6."""

CASES = {
    "Jordan block of four": ("adaptive", (0.3,)),
    "complex": ("complex", (1.0 + 1.0j, 0.5 + 0.8j)),
    "complex Jordan blocks": ("complex_jordan", (0.8 + 0.6j,)),
}
"""Variant and eigenvalues."""

PARTS = (0.5, 0.9, 1.1)
"""Of the bound of (3.14)."""

NEAR = (
    "trajectory_generator.amplitude=[1.0, -1.0, 2.0, 0.5]",
    "fpt_deformer.initial_response=[0.0, 0.0, 0.0, 1.0e-7]",
)
"""The solution is r = 0; the iteration starts 1e-7 beside it, where the sigmoid is straight."""


def bound(name: str) -> float:
    """The least of -2 Re lambda / |lambda|^2 of the eigenvalues, as a gain A."""
    return -min(2.0 * z.real / abs(z) ** 2 for z in map(complex, CASES[name][1])) / SLOPE


def _key(name: str, part: float) -> str:
    return f"{name}, {part:g} of the bound"


def _setup(name: str, part: float) -> Setup:
    settings = (*NEAR, f"fpt_deformer.A={part * bound(name):.6g}")
    return Setup(MAP, CASES[name][0], settings, 1500.0)


def _converges(runs: Runs) -> Verdict:
    rows: list[tuple[str, ...]] = []
    held: list[bool] = []
    grown: dict[str, float | str | None] = {}
    for name in CASES:
        for part in PARTS:
            run = runs[_key(name, part)]
            h = sizes(run)
            converged = complete(run) and float(h[-1]) < 1e-3 * float(h[0])
            held.append(converged == (part < 1.0))
            growth = float(np.max(h) / h[0])
            if converged:
                grown[name] = max(growth, float(grown.get(name) or 0.0))
            rows.append(
                (
                    name,
                    f"{part:g}",
                    "converges" if converged else "does not",
                    f"{growth:.3g}" if converged else "",
                )
            )
    return Verdict(
        YES if all(held) else ONLY_IF if any(held) else NO,
        {f"largest ||h|| over the first one, {name}": each for name, each in grown.items()},
        "At 0.9 of the bound each of them converges, at 1.1 none. The powers of m in (3.12) are "
        "no matter of convergence, but of the way to it: the response error grows at first.",
        Table(("eigenvalues", "part of the bound", "iteration", "growth before"), tuple(rows)),
    )


CLAIMS = (
    Claim(
        "3.2.1",
        "",
        "Complex eigenvalues and Jordan blocks converge too where |1 + mu lambda| < 1, as "
        "m^(S-1) |1 + mu lambda|^(m+1-S) vanishes (3.9)-(3.15).",
        {_key(name, part): _setup(name, part) for name in CASES for part in PARTS},
        _converges,
        (
            Picture(
                "",
                "Jordan block of four, and complex eigenvalues",
                draw.iterations(_key("Jordan block of four", 0.9), _key("complex", 0.5), first=60),
                "The block's error grows by orders of magnitude before it vanishes.",
            ),
        ),
    ),
)
