"""Section 2.2.1: the classical adaptive inverse dynamics controller."""

from fpt_ros.thesis import drawings as draw
from fpt_ros.thesis.claim import NO, ONLY_IF, YES, Claim, Picture, Verdict
from fpt_ros.thesis.learning import coefficient_table, coefficients, learned, tuned
from fpt_ros.thesis.measures import settled_rms
from fpt_ros.thesis.setup import Runs, Setup


def _slow_learning(runs: Runs) -> Verdict:
    start, m, exact = coefficients(runs["tuned"])["m"]
    part = learned(start, m, exact)
    fixed, found = (settled_rms(runs[key], "q1") for key in ("not tuned", "tuned"))
    return Verdict(
        YES if found > 0.8 * fixed and part < 0.75 else NO,
        {
            "m^ after 60 s (from 9, exact 10)": m,
            "rms error, tuned": found,
            "rms error, not tuned": fixed,
        },
        f"A minute of learning makes the tracking only {fixed / found:.3g} times as precise.",
        coefficient_table({"tuned": runs["tuned"]}),
    )


def _offset(R: float, start: str) -> Setup:
    return Setup("vdp_aidc", start, (f"parameter_tuner.R={R:g}",))


RESTS, OFFSETS = (5.0, 0.2, 0.1, 0.01), (5.0, 0.2, 0.1)


def _small_r(runs: Runs) -> Verdict:
    def least(start: str, R: float) -> float:
        return float(tuned(runs[f"{start}, R = {R:g}"], "m")[1].min())

    rest = {R: least("rest", R) for R in RESTS}
    offset = {R: least("offset", R) for R in OFFSETS}
    singular = min(offset.values()) <= 0.0
    harmless = min(rest.values()) > 1.0
    return Verdict(
        (ONLY_IF if harmless else YES) if singular else NO,
        {f"least m^ from an offset, R = {R:g}": m for R, m in offset.items()}
        | {f"least m^ from rest, R = {R:g}": m for R, m in rest.items()},
        "Only if the motion begins beside the nominal one (here q = 1, q' = 3): then m^ dips, "
        "and with R = 0.1 it passes zero. From rest m^ only grows, and even R = 0.01 is harmless.",
    )


def _not_compensated(runs: Runs) -> Verdict:
    quiet, tuned_, fixed = (
        settled_rms(runs[key], "q1") for key in ("undisturbed", "disturbed", "disturbed, not tuned")
    )
    return Verdict(
        YES if tuned_ > 1.5 * quiet and tuned_ > 0.8 * fixed else NO,
        {
            "rms error, undisturbed": quiet,
            "rms error, disturbed": tuned_,
            "rms error, disturbed, not tuned": fixed,
        },
        f"The disturbance makes the error {tuned_ / quiet:.3g} times as large; the tuning takes "
        f"away {1 - tuned_ / fixed:.0%} of what it is without any.",
    )


CLAIMS = (
    Claim(
        "2.2.1",
        "2.1-2.4",
        "The learning speed of the classical adaptive inverse dynamics controller is very small.",
        {"not tuned": Setup("vdp_aidc", "fixed"), "tuned": Setup("vdp_aidc")},
        _slow_learning,
        (Picture("", "Tracking error", draw.errors("not tuned", "tuned")),),
    ),
    Claim(
        "2.2.1",
        "",
        "Some decrease of R causes singularities in the tuning process: m^ reaches zero.",
        {
            **{f"rest, R = {R:g}": _offset(R, "adaptive") for R in RESTS},
            **{f"offset, R = {R:g}": _offset(R, "offset") for R in OFFSETS},
        },
        _small_r,
        (
            Picture(
                "",
                "The estimated inertia as R decreases",
                draw.parameters(
                    "offset, R = 5", "offset, R = 0.2", "offset, R = 0.1", names=("m",)
                ),
            ),
        ),
    ),
    Claim(
        "2.2.1",
        "2.1-2.4",
        "The tuning compensates the effects of unknown external disturbances improperly.",
        {
            "undisturbed": Setup("vdp_aidc"),
            "disturbed": Setup("vdp_aidc", "disturbed"),
            "disturbed, not tuned": Setup("vdp_aidc", "fixed_disturbed"),
        },
        _not_compensated,
        (
            Picture("2.1", "Tracking error", draw.errors("undisturbed", "disturbed")),
            Picture("2.2", "Disturbance forces", draw.disturbance("disturbed")),
            Picture(
                "2.3, 2.4", "Tuning of the parameters", draw.parameters("undisturbed", "disturbed")
            ),
        ),
    ),
)
