"""Section 2.5.1: whether the inner iteration converges as printed."""

from fpt_ros.thesis import drawings as draw
from fpt_ros.thesis.chapter2.s2_5_coupled_masses import MASSES
from fpt_ros.thesis.claim import NO, ONLY_IF, YES, Claim, Picture, Verdict
from fpt_ros.thesis.learning import window
from fpt_ros.thesis.measures import complete, end
from fpt_ros.thesis.setup import Runs, Setup


def _inner_iteration(runs: Runs) -> Verdict:
    scaled, printed = (
        window(runs[key], "inner_residual", 15.0, 20.0) for key in ("scaled", "A2 = -3")
    )
    literal = runs["alpha = -0.3"]
    limit_cycle = printed > 10.0 * scaled
    return Verdict(
        ONLY_IF if limit_cycle and scaled < 1.0 else YES if not limit_cycle else NO,
        {
            "inner residual, rms of the last 5 s, A2 = -3 / ||Y Y^T|| [N]": scaled,
            "inner residual, rms of the last 5 s, A2 = -3 [N]": printed,
            "alpha = -0.3: lost at [s]": None if complete(literal) else end(literal),
        },
        "Only if A2 is divided by the norm of Y Y^T: its constant columns make the largest "
        "eigenvalue 6.7 to 262, where A2 = -3 contracts up to 1.68 only; as printed the "
        "iteration ends in a limit cycle. The printed alpha = -0.3 with the printed minus is "
        "+0.3.",
    )


CLAIMS = (
    Claim(
        "2.5.1",
        "",
        "The inner iteration (2.28) converges with the printed parameters (D = 0.3, A2 = -3).",
        {
            "scaled": Setup(MASSES),
            "A2 = -3": Setup(MASSES, settings=("parameter_tuner.scaled=false",)),
            "alpha = -0.3": Setup(MASSES, settings=("parameter_tuner.alpha=-0.3",)),
        },
        _inner_iteration,
        (
            Picture(
                "",
                "What the inner iteration leaves",
                draw.parameters("scaled", "A2 = -3", names=("inner_residual",)),
            ),
        ),
    ),
)
