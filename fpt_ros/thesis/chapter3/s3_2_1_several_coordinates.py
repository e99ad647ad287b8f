"""Section 3.2.1: the deformation of several coordinates, iterated barely."""

from fpt_ros.analysis.sizes import finite
from fpt_ros.thesis import drawings as draw
from fpt_ros.thesis.chapter3.s3_1_1_bare_iteration import below, sizes
from fpt_ros.thesis.claim import NO, ONLY_IF, YES, Claim, Picture, Table, Verdict
from fpt_ros.thesis.measures import complete
from fpt_ros.thesis.setup import Runs, Setup
from fpt_ros.thesis.words import because

MIMO = "mimo_affine"
SLOW = tuple(round(-0.05 * i, 2) for i in range(1, 15))
NEAR = "fpt_deformer.initial_response=[0.7287434, -1.5321020]"


def _printed_gain(runs: Runs) -> Verdict:
    h = sizes(runs["A = 0.20"])
    converged = complete(runs["A = 0.20"]) and float(h[-1]) < 1e-3
    return Verdict(
        YES if converged else NO,
        {"||h|| at the start": float(h[0]), "||h|| after 400 iterations": finite(float(h[-1]))},
        "It converges."
        if converged
        else "It diverges: for a response matrix with positive eigenvalues A has to be negative, "
        "as (3.14) itself says.",
    )


def _negative_gain(runs: Runs) -> Verdict:
    found = {key: sizes(run) for key, run in runs.items()}
    counts = {key: (below(h, 1e-3), below(h, 1e-6)) for key, h in found.items()}
    good = all(count is not None for pair in counts.values() for count in pair)
    measured: dict[str, float | str | None] = {}
    for key, (rough, fine) in counts.items():
        measured[f"iterations until ||h|| < 1e-3, {key}"] = rough
        measured[f"iterations until ||h|| < 1e-6, {key}"] = fine
    return Verdict(
        ONLY_IF if good else NO,
        measured,
        because(
            good, "Only if A is taken with the minus that the print has lost: then both converge."
        ),
    )


def _linear_condition(runs: Runs) -> Verdict:
    rows, agreeing = [], []
    for A in SLOW:
        inside = abs(A) < 0.6321492
        near, far = runs[f"near, A = {A:g}"], runs[f"from 0, A = {A:g}"]
        ends = [complete(run) and float(sizes(run)[-1]) < 1e-6 for run in (near, far)]
        agreeing.append((ends[0] == inside, ends[1] == inside))
        if A <= -0.35:
            words = ["converges" if each else "does not" for each in ends]
            rows.append((f"{A:g}", "converges" if inside else "does not", *words))
    near_held, far_held = (all(column) for column in zip(*agreeing, strict=True))
    return Verdict(
        (YES if far_held else ONLY_IF) if near_held else NO,
        {
            "linear bound of A": -0.6321492,
            "last A that converges, started near": min(
                A for A in SLOW if float(sizes(runs[f"near, A = {A:g}"])[-1]) < 1e-6
            ),
            "last A that converges, started at 0": min(
                A for A in SLOW if float(sizes(runs[f"from 0, A = {A:g}"])[-1]) < 1e-6
            ),
        },
        "Only if the iteration starts near the solution: it is a condition of the linearised "
        "map. From r = 0 the iteration ends in a cycle of two before that bound.",
        Table(("A", "(3.14)", "started 1e-3 away", "started at 0"), tuple(rows)),
    )


def _gain(A: float, *more: str) -> Setup:
    return Setup(MIMO, settings=(f"fpt_deformer.A={A:g}", *more))


CLAIMS = (
    Claim(
        "3.2.1",
        "3.20",
        "The extension to several coordinates converges for the printed A = 0.20 and A = 0.27425.",
        {"A = 0.20": Setup(MIMO, "printed_sign")},
        _printed_gain,
    ),
    Claim(
        "3.2.1",
        "3.20",
        "The extension along the direction of the response error converges to the desired values "
        "for a coupled affine system, |A| = 0.20 and |A| = 0.27425.",
        {"A = -0.20": Setup(MIMO), "A = -0.27425": Setup(MIMO, "fast")},
        _negative_gain,
        (
            Picture(
                "3.20",
                "Bare iteration in two dimensions",
                draw.iterations("A = -0.20", "A = -0.27425", first=80),
            ),
        ),
    ),
    Claim(
        "3.2.1",
        "",
        "The iteration converges where |1 + F'(x*) A lambda| < 1 for every eigenvalue "
        "(3.13)-(3.15).",
        {
            **{f"near, A = {A:g}": _gain(A, NEAR) for A in SLOW},
            **{f"from 0, A = {A:g}": _gain(A) for A in SLOW},
        },
        _linear_condition,
    ),
)
