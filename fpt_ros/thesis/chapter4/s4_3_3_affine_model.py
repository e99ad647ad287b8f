"""Section 4.3.3: the spherical pendulum with an affine model; what its models have in common."""

from fpt_ros.runs.run import Run
from fpt_ros.thesis import drawings as draw
from fpt_ros.thesis.chapter4.weights_figure import weights_figure
from fpt_ros.thesis.claim import Claim, Picture, Verdict
from fpt_ros.thesis.judges import precise
from fpt_ros.thesis.setup import Runs, Setup

SPHERE = "spherical_pendulum"


def _affine_model(runs: Runs) -> Verdict:
    verdict = precise("adaptive", "nonadaptive", 100.0)(runs)
    return Verdict(
        verdict.status,
        verdict.measured,
        f"{verdict.reason} The model errors do corrupt the non-adaptive tracking: a constant in "
        "the place of all forces is enough once the response is deformed.",
    )


MODELS = {
    "affine": ("nonadaptive", "adaptive"),
    "fuzzy sine": ("fuzzy_sin_nonadaptive", "fuzzy_sin"),
    "fully fuzzy": ("fully_fuzzy_nonadaptive", "fully_fuzzy"),
}


def model_pair(model: str) -> dict[str, Setup]:
    """A model of ``MODELS`` without and with deformation."""
    without, with_it = MODELS[model]
    return {"nonadaptive": Setup(SPHERE, without), "adaptive": Setup(SPHERE, with_it)}


def model_pictures(track: str, response: str, weights: str) -> tuple[Picture[Run], ...]:
    """What the thesis shows of every model; the arguments: its figures."""
    return (
        Picture(track, "Trajectory tracking", draw.tracking("nonadaptive", "adaptive")),
        Picture(track, "Tracking error", draw.errors("nonadaptive", "adaptive")),
        Picture(response, "Second derivatives", draw.responses("nonadaptive", "adaptive")),
        Picture(weights, "Tuned weights, forgetting buffer", weights_figure("adaptive")),
    )


CLAIMS = (
    Claim(
        "4.3.3",
        "4.16-4.18",
        "With the affine model the modelling errors corrupt the non-adaptive tracking; the "
        "adaptive controller is precise.",
        model_pair("affine"),
        _affine_model,
        model_pictures("4.16, 4.17", "4.18", "4.19")[:3],
    ),
)
