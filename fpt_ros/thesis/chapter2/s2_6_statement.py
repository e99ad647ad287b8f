"""Section 2.6: thesis statement I."""

from fpt_ros.thesis.chapter2.s2_2_2_modified_tuning import MODIFIED
from fpt_ros.thesis.chapter2.s2_4_cart_beam_hamper import CART
from fpt_ros.thesis.chapter2.s2_5_coupled_masses import MASSES
from fpt_ros.thesis.claim import NO, ONLY_IF, YES, Claim, Table, Verdict
from fpt_ros.thesis.learning import coefficients, learned
from fpt_ros.thesis.setup import Runs, Setup


def _efficient_identification(runs: Runs) -> Verdict:
    rows = []
    best = {}
    for key, run in runs.items():
        found = coefficients(run)
        gone = {name: learned(*c) for name, c in found.items()}
        best[key] = sum(part >= 0.9 for part in gone.values()), len(gone)
        rows.append(
            (
                key,
                f"{best[key][0]} of {best[key][1]}",
                f"{sum(part > 0 for part in gone.values())} of {len(gone)}",
                f"{min(gone.values()):.0%} to {max(gone.values()):.0%}",
            )
        )
    some = any(count for count, _ in best.values())
    every = all(count == total for count, total in best.values())
    return Verdict(
        YES if every else ONLY_IF if some else NO,
        {
            f"{key}: parameters with 90 % of the error gone, of {n}": float(c)
            for key, (c, n) in best.items()
        },
        "Only if the motion tells the parameters apart, nothing disturbs it, and there is time.",
        Table(
            ("run", "90 % of the error gone", "closer than at the start", "part that is gone"),
            tuple(rows),
        ),
    )


CLAIMS = (
    Claim(
        "2.6",
        "2.6-2.7, 2.14, 2.28-2.31",
        "The proposed algorithms ensure efficient parameter identification (statement I).",
        {
            "projection, van der Pol, 60 s": MODIFIED,
            "Gram-Schmidt, cart, 30 s": Setup(CART),
            "Gram-Schmidt, cart, friction": Setup(CART, "lugre"),
            "fixed point, coupled masses, 20 s": Setup(MASSES),
        },
        _efficient_identification,
    ),
)
