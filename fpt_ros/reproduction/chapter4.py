"""Chapter 4: other functions, time sharing, and soft computing-based models."""

from fpt_ros.reproduction import (
    NO,
    ONLY_IF,
    Case,
    Claim,
    Group,
    Judge,
    Outcomes,
    Pictures,
    Verdict,
    holds,
    times,
)
from fpt_ros.reproduction.probes import responses, weights


def _shared(runs: Outcomes) -> Verdict:
    plain, adaptive = runs["nonadaptive"], runs["adaptive"]
    measured = ", ".join(
        f"{name} {plain.error(name):.3g} -> {adaptive.error(name):.3g}" for name in ("q1", "q2")
    )
    better = all(adaptive.error(name) < 0.5 * plain.error(name) for name in ("q1", "q2"))
    reason = (
        "the nominal swing is near the natural frequency: only then q1 and q2 = 0 are nearly "
        "compatible, and one torque can serve both"
    )
    return Verdict(ONLY_IF if better else NO, f"rms error {measured}", reason)


def _realised(runs: Outcomes) -> Verdict:
    a, b = (runs[key].probes["response_error"] for key in ("adaptive", "nonadaptive"))
    measured = f"rms of realised less desired response {a:.3g}, without deformation {b:.3g} rad/s^2"
    return holds(a < 0.05 * b, measured)


SWING = Group(
    "The swing",
    {
        "adaptive": Case("swing"),
        "nonadaptive": Case("swing", "nonadaptive"),
        "A=-6": Case("swing", "adaptive", ("fpt_deformer.A=-6.0",)),
    },
    (
        Claim(
            "4.1.2",
            "4.3, 4.4",
            "Time sharing lets one torque track two coordinates, the better with adaptation.",
            ("nonadaptive", "adaptive"),
            _shared,
        ),
        Claim(
            "4.1.2",
            "4.5, 4.6",
            "The realised second derivative quickly converges to the desired one in its time slot.",
            ("nonadaptive", "adaptive"),
            _realised,
        ),
    ),
    (
        Pictures(
            ("nonadaptive", "adaptive"), ("tracking", "tracking_error", "responses_zoom", "forces")
        ),
    ),
    responses,
)


def _kapitza(runs: Outcomes) -> Verdict:
    a, b = runs["adaptive"].error(), runs["nonadaptive"].error()
    return holds(a < 0.001 * b, f"rms error {a:.3g} rad instead of {b:.3g}: {times(a, b)} smaller")


def _readings(runs: Outcomes) -> Verdict:
    measured = "; ".join(
        f"{name}: rms error {runs[key].error():.3g}, settled chatter "
        f"{runs[key].probes['settled_chatter']:.3g}"
        for key, name in (
            ("adaptive", "(4.7) as printed"),
            ("listing", "listing"),
            ("with_gravity", "(4.6)"),
        )
    )
    quiet = runs["adaptive"].probes["settled_chatter"]
    loud = runs["listing"].probes["settled_chatter"]
    reason = (
        "q1'' follows (4.7) literally, for |q2| < 0.51: only there the printed A = -10 contracts; "
        "the other readings end in a regular two-cycle that leaves the tracking unharmed"
    )
    return Verdict(ONLY_IF if quiet < 0.01 * loud else NO, measured, reason)


KAPITZA = Group(
    "Kapitza's pendulum",
    {
        key: Case("kapitza", key)
        for key in ("adaptive", "nonadaptive", "listing", "with_gravity", "offset")
    },
    (
        Claim(
            "4.2.1",
            "4.10, 4.11, 4.14, 4.15",
            "The new function makes the pendulum follow the nominal motion precisely.",
            ("nonadaptive", "adaptive"),
            _kapitza,
        ),
        Claim(
            "4.2.1",
            "4.12, 4.13",
            "A = -10 is a good setting: the desired and the realised response coincide.",
            ("adaptive", "listing", "with_gravity", "offset"),
            _readings,
        ),
    ),
    (
        Pictures(
            ("nonadaptive", "adaptive"),
            ("tracking", "tracking_error", "responses", "responses_zoom", "forces"),
        ),
        Pictures(("listing", "with_gravity", "offset"), ("tracking_error", "responses_zoom")),
    ),
    responses,
)


def _soft(adaptive: str, plain: str) -> Judge:
    def judge(runs: Outcomes) -> Verdict:
        a, b = runs[adaptive].error(), runs[plain].error()
        return holds(a * 50.0 < b, f"largest rms error {a:.3g} rad instead of {b:.3g}")

    return judge


def _tuned(runs: Outcomes) -> Verdict:
    tuned, fixed, big = runs["adaptive"], runs["fixed_weights"], runs["weights 8"]
    measured = (
        f"rms error q1 {tuned.error('q1'):.3g}, q2 {tuned.error('q2'):.3g} with tuned weights (up "
        f"to {tuned.probes['largest_weight']:.2f}), {fixed.error('q1'):.3g}, "
        f"{fixed.error('q2'):.3g} with weights of 1; settled chatter "
        f"{tuned.probes['settled_chatter']:.2g}, with weights of 8 "
        f"{big.probes['settled_chatter']:.2g}"
    )
    better = tuned.error("q2") < 0.5 * fixed.error("q2")
    quiet = tuned.probes["settled_chatter"] < 0.05 * big.probes["settled_chatter"]
    reason = "the tuning helps q2 and leaves q1 as it is; its rates are not printed"
    return Verdict(ONLY_IF if better and quiet else NO, measured, reason)


def _simple(runs: Outcomes) -> Verdict:
    full, affine = runs["fully_fuzzy_nonadaptive"].error(), runs["nonadaptive"].error()
    a, b = runs["fully_fuzzy"].error(), runs["adaptive"].error()
    measured = (
        f"without deformation {full:.3g} (fully fuzzy) and {affine:.3g} (affine); with it "
        f"{a:.3g} and {b:.3g}"
    )
    return holds(full < 0.5 * affine and b < 3.0 * a, measured)


SPHERICAL = Group(
    "Spherical pendulum",
    {
        **{
            key: Case("spherical_pendulum", key)
            for key in (
                "adaptive",
                "nonadaptive",
                "fixed_weights",
                "fuzzy_sin",
                "fuzzy_sin_nonadaptive",
                "fully_fuzzy",
                "fully_fuzzy_nonadaptive",
            )
        },
        "weights 8": Case(
            "spherical_pendulum", "fixed_weights", ("fpt_deformer.weights=[8.0, 8.0]",)
        ),
    },
    (
        Claim(
            "4.3.3",
            "4.16-4.18",
            "With an affine model the adaptive controller tracks precisely.",
            ("nonadaptive", "adaptive"),
            _soft("adaptive", "nonadaptive"),
        ),
        Claim(
            "4.3.2",
            "4.19",
            "Tuning the diagonal weights by the forgetting buffer improves the convergence.",
            ("fixed_weights", "adaptive", "weights 8"),
            _tuned,
        ),
        Claim(
            "4.3.4",
            "4.20-4.24",
            "The same with a fuzzy approximation of the sine.",
            ("fuzzy_sin_nonadaptive", "fuzzy_sin"),
            _soft("fuzzy_sin", "fuzzy_sin_nonadaptive"),
        ),
        Claim(
            "4.3.5",
            "4.25-4.28",
            "The same with a model made of fuzzy functions throughout.",
            ("fully_fuzzy_nonadaptive", "fully_fuzzy"),
            _soft("fully_fuzzy", "fully_fuzzy_nonadaptive"),
        ),
        Claim(
            "4.4.2",
            "",
            "The design deals with the imprecision of the models: the poorest does nearly as well.",
            ("nonadaptive", "adaptive", "fully_fuzzy_nonadaptive", "fully_fuzzy"),
            _simple,
        ),
    ),
    tuple(
        Pictures(pair, ("tracking", "tracking_error", "responses", "parameters"))
        for pair in (
            ("nonadaptive", "adaptive"),
            ("fuzzy_sin_nonadaptive", "fuzzy_sin"),
            ("fully_fuzzy_nonadaptive", "fully_fuzzy"),
        )
    ),
    weights,
)

GROUPS = (SWING, KAPITZA, SPHERICAL)
