"""Chapter 2, before (2.1): pseudo-inverses beside the modified Gram-Schmidt algorithm."""

from collections.abc import Mapping

import numpy as np

from fpt_ros.runs.run import Run
from fpt_ros.thesis.chapter2.s2_4_cart_beam_hamper import CART
from fpt_ros.thesis.claim import NO, ONLY_IF, YES, Claim, Table, Verdict
from fpt_ros.thesis.cost import Cost
from fpt_ros.thesis.learning import coefficients, learned
from fpt_ros.thesis.measures import complete, end, settled_rms
from fpt_ros.thesis.setup import Runs, Setup

METHODS = {
    "gram_schmidt": "modified Gram-Schmidt",
    "damped": "damped pseudo-inverse",
    "truncated_svd": "truncated SVD",
    "moore_penrose": "Moore-Penrose",
}
SHAPES = ((2, 5), (3, 8), (6, 40), (7, 70))
"""Rows and coefficients: the thesis's examples, and what arms have."""


def _cost(counts: Mapping[str, int]) -> Verdict:
    def of(method: str, shape: tuple[int, int]) -> int:
        return counts[_key(method, shape)]

    against = {
        method: min(of(method, shape) / of("gram_schmidt", shape) for shape in SHAPES)
        for method in METHODS
        if method != "gram_schmidt"
    }
    svd, damped = against["truncated_svd"], against["damped"]
    rows = tuple(
        (name, *(f"{of(method, shape)}" for shape in SHAPES)) for method, name in METHODS.items()
    )
    return Verdict(
        YES if min(against.values()) > 1.0 else ONLY_IF if svd > 1.0 else NO,
        {f"operations, {METHODS[m]} / Gram-Schmidt, at least": x for m, x in against.items()},
        f"Only if it is compared with the singular value decomposition, which costs at least "
        f"{svd:.2g} times as much. Y Y^T + mu I by Cholesky's method costs {damped:.2g} times as "
        "much at the least: it is as simple, and never singular.",
        Table(("operations in a cycle", *(f"{r} rows, {s} parameters" for r, s in SHAPES)), rows),
    )


def _key(method: str, shape: tuple[int, int]) -> str:
    return f"{METHODS[method]}, {shape[0]} x {shape[1]}"


def _same_result(runs: Runs) -> Verdict:
    rows, errors = [], {}
    for key, run in runs.items():
        gone = {name: learned(*c) for name, c in coefficients(run).items()}
        errors[key] = max(settled_rms(run, name) for name in ("q1", "q2", "q3"))
        fate = f"{errors[key]:.3g}" if complete(run) else f"lost at {end(run):.2f} s"
        rows.append((key, fate, f"{min(gone.values()):.0%} to {max(gone.values()):.0%}"))
    best, ours = min(errors.values()), errors[METHODS["gram_schmidt"]]
    return Verdict(
        YES if ours < 1.5 * best else ONLY_IF if ours < 5.0 * best else NO,
        {f"largest settled rms error, {key}": x for key, x in errors.items()},
        f"With Gram-Schmidt the largest settled error is {ours / best:.3g} times that of the best "
        "of the four.",
        Table(("tuning", "largest rms error", "part of the parameters' errors gone"), tuple(rows)),
    )


DRAWS = 12


def _random_matrices(seed: int) -> tuple[str, str]:
    """R and Q, symmetric with eigenvalues spread over a factor of 100 around the printed ones."""
    random = np.random.default_rng(seed)

    def matrix(order: int, middle: float) -> str:
        turn = np.linalg.qr(random.normal(size=(order, order)))[0]
        square = turn @ np.diag(middle * 10.0 ** random.uniform(-1.0, 1.0, order)) @ turn.T
        numbers = np.round((square + square.T) / 2.0, 6).ravel().tolist()
        return "[" + ", ".join(map(str, numbers)) + "]"

    return (
        f"parameter_tuner.R_matrix={matrix(6, 5.0)}",
        f"parameter_tuner.Q_matrix={matrix(2, 100.0)}",
    )


def _arbitrary(runs: Runs) -> Verdict:
    printed = settled_rms(runs["printed"], "q1")
    drawn = {key: run for key, run in runs.items() if key != "printed"}
    errors = [settled_rms(run, "q1") for run in drawn.values()]
    kept = [x for x in errors if np.isfinite(x)]
    better = sum(x < printed for x in errors)
    spread = max(kept, default=np.inf) / min(kept, default=np.inf)
    return Verdict(
        YES if spread > 2.0 or len(kept) < len(errors) else ONLY_IF if spread > 1.2 else NO,
        {
            "rms error, printed R and Q": printed,
            "rms error, best draw": min(kept, default=np.inf),
            "rms error, worst draw that is not lost": max(kept, default=np.inf),
            "draws that are lost": float(len(errors) - len(kept)),
        },
        f"Only if it is meant that nothing says which to take: of {len(errors)} random pairs of R "
        f"and Q, all of which Lyapunov's theorem allows, {better} are better than the printed "
        "ones; but over a factor of 100 of their eigenvalues the settled error differs by "
        f"{spread:.3g} only.",
    )


CLAIMS: tuple[Claim[int] | Claim[Run], ...] = (
    Claim(
        "2",
        "",
        "The modified Gram-Schmidt algorithm is far simpler than pseudo-inverses, and needs less "
        "computation.",
        {_key(method, shape): Cost(method, *shape) for method in METHODS for shape in SHAPES},
        _cost,
    ),
    Claim(
        "2",
        "",
        "It does what the generalised inverses do for the given known term.",
        {
            name: Setup(CART, "adaptive" if method == "gram_schmidt" else method, duration=10.0)
            for method, name in METHODS.items()
        },
        _same_result,
    ),
    Claim(
        "2.2.1",
        "",
        "The Lyapunov based design has numerous arbitrary adaptive control parameters.",
        {
            "printed": Setup("vdp_aidc", duration=20.0),
            **{
                f"draw {seed}": Setup("vdp_aidc", settings=_random_matrices(seed), duration=20.0)
                for seed in range(DRAWS)
            },
        },
        _arbitrary,
    ),
)
