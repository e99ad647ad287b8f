"""Chapter 3: sigmoid generated fixed point transformations."""

from fpt_ros.reproduction import (
    NO,
    ONLY_IF,
    YES,
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
from fpt_ros.reproduction.probes import gain, iteration, responses


def _gain(name: str, A: float, variant: str = "adaptive", *more: str) -> Case:
    return Case(name, variant, (f"fpt_deformer.A={A:g}", *more))


def _slow(runs: Outcomes) -> Verdict:
    p = runs["adaptive"].probes
    measured = f"{p['turns']:.0f} changes of sign, |h| < 1e-3 after {p['steps_1e-3']:.0f} steps"
    return holds(p["turns"] == 0 and p["last"] < 1e-9, measured)


def _fast(runs: Outcomes) -> Verdict:
    p, slow = runs["fast"].probes, runs["adaptive"].probes
    measured = (
        f"|h| < 1e-3 after {p['steps_1e-3']:.0f} steps instead of {slow['steps_1e-3']:.0f}; "
        f"overshoot {p['overshoot']:.2g}"
    )
    reason = "fast, but not strictly monotone: h changes its sign with a multiplier of -0.27"
    return Verdict(ONLY_IF if p["steps_1e-3"] < slow["steps_1e-3"] else NO, measured, reason)


def _precursor(runs: Outcomes) -> Verdict:
    p = runs["precursor"].probes
    measured = f"{p['turns']:.0f} changes of sign, |h| < 1e-3 after {p['steps_1e-3']:.0f} steps"
    return holds(p["turns"] > 50 and p["largest_late"] < 2.0 and p["last"] < 1e-6, measured)


def _chaos(runs: Outcomes) -> Verdict:
    p = runs["chaos"].probes
    measured = f"|h| up to {p['largest_late']:.3g} in the last 1000 of 4000 steps"
    reason = (
        "chaotic and bounded: it does not diverge (Lyapunov exponent 0.58); from 6.364 on it does"
    )
    return Verdict(ONLY_IF if 0.5 < p["largest_late"] < 10.0 else NO, measured, reason)


SISO = Group(
    "The bare iteration, one dimension",
    {key: Case("siso_affine", key) for key in ("adaptive", "fast", "precursor", "chaos")},
    (
        Claim("3.1.1", "3.4", "A = -0.5: slow monotone convergence.", ("adaptive",), _slow),
        Claim("3.1.1", "3.5", "A = -2: fast monotone convergence.", ("fast", "adaptive"), _fast),
        Claim("3.1.1", "3.6", "A = -3.12: precursor oscillations.", ("precursor",), _precursor),
        Claim("3.1.1", "3.7", "A = -6: chaotic, divergent oscillations.", ("chaos",), _chaos),
    ),
    (
        Pictures(("adaptive", "fast"), ("responses",)),
        Pictures(("precursor", "chaos"), ("responses",)),
    ),
    iteration,
)


def _converges(runs: Outcomes) -> Verdict:
    slow, fast, printed = (runs[key].probes for key in ("adaptive", "fast", "printed_sign"))
    measured = (
        f"A = -0.20, -0.27425: |h| < 1e-6 after {slow['steps_1e-6']:.0f}, {fast['steps_1e-6']:.0f} "
        f"steps; with the sign as printed |h| = {printed['last']:.3g} after 400"
    )
    good = slow["last"] < 1e-9 and fast["last"] < 1e-9 and printed["last"] > 100.0
    return Verdict(ONLY_IF if good else NO, measured, "A is negative (printed positive)")


MIMO = Group(
    "The bare iteration, two dimensions",
    {key: Case("mimo_affine", key) for key in ("adaptive", "fast", "printed_sign")},
    (
        Claim(
            "3.2.1",
            "3.20",
            "The MIMO iteration converges for A = 0.20 and faster for 0.27425.",
            ("adaptive", "fast", "printed_sign"),
            _converges,
        ),
    ),
    (Pictures(("adaptive", "fast", "printed_sign"), ("responses",)),),
    iteration,
)


def _better(adaptive: str, plain: str, factor: float) -> Judge:
    def judge(runs: Outcomes) -> Verdict:
        a, b = runs[adaptive].error(), runs[plain].error()
        measured = f"rms error {a:.3g} instead of {b:.3g}: {times(a, b)} smaller"
        return holds(a * factor < b, measured)

    return judge


def _observed(runs: Outcomes) -> Verdict:
    a, b = runs["observer"].error(), runs["adaptive"].error()
    return holds(a < 2.0 * b, f"rms error {a:.3g} with the observer, {b:.3g} with w measured")


NEURON = Group(
    "Neuron after neuron",
    {
        key: Case("fitzhugh_nagumo", key)
        for key in (
            "adaptive",
            "nonadaptive",
            "disturbed",
            "nonadaptive_disturbed",
            "observer",
            "observer_disturbed",
        )
    },
    (
        Claim(
            "3.1.2",
            "3.8-3.13",
            "The adaptive controller tracks far more precisely than the non-adaptive one.",
            ("nonadaptive", "adaptive"),
            _better("adaptive", "nonadaptive", 10.0),
        ),
        Claim(
            "3.1.2",
            "3.14-3.19",
            "The same holds under external disturbances.",
            ("nonadaptive_disturbed", "disturbed"),
            _better("disturbed", "nonadaptive_disturbed", 8.0),
        ),
        Claim(
            "3.1.2",
            "",
            "An observer with the approximate parameters can stand in for w.",
            ("observer", "adaptive"),
            _observed,
        ),
    ),
    (
        Pictures(
            ("nonadaptive", "adaptive"),
            ("tracking", "tracking_error", "phase_trajectories", "responses", "forces"),
        ),
        Pictures(
            ("nonadaptive_disturbed", "disturbed"),
            ("tracking", "tracking_error", "phase_trajectories", "responses", "forces"),
        ),
    ),
    responses,
)

SCAN = tuple(-2.9 - 0.025 * i for i in range(41))
"""Gains of TORA between which the chattering sets in."""


def _precision(runs: Outcomes) -> Verdict:
    plain, weak, strong = (runs[key].error() for key in ("nonadaptive", "adaptive", "strong"))
    measured = f"largest rms error {plain:.3g}, {weak:.3g} (A = -0.1), {strong:.3g} (A = -3.125)"
    return holds(strong < 0.2 * weak and weak < 0.1 * plain, measured)


def _onset(runs: Outcomes) -> Verdict:
    quiet = [A for A in SCAN if (runs[f"A={A:g}"].probes.get("settled_chatter") or 9.0) < 0.1]
    loud = [A for A in SCAN if A not in quiet]
    first = max(loud, default=float("nan"))
    measured = f"first chattering A = {first:g}, last quiet A = {min(quiet):g} (steps of 0.025)"
    inside = -3.9 <= first <= -3.3
    reason = (
        "the place depends on the nominal motion, which is not printed: it lies in the window "
        "-2.95 .. -4.66 in which quiet tracking and a two-cycle exist side by side (fpt gain tora)"
    )
    return Verdict(ONLY_IF if inside else NO, measured, reason)


def _insignificant(runs: Outcomes) -> Verdict:
    a, b = runs["adaptive"], runs["nonadaptive"]
    reach, plain = a.probes["largest_q1"], b.probes["largest_q1"]
    measured = f"|q1| reaches {reach:.3f} rad, without adaptation {plain:.3f} rad"
    return holds(abs(reach - plain) < 0.1 * plain, measured)


def _guarded(runs: Outcomes) -> Verdict:
    loud, quiet = runs["chatter"], runs["guarded"]
    factor = quiet.tuning["gain_factor"][1]
    index = quiet.tuning["precursor"]
    measured = (
        f"started at A = -4.2: settled chatter {loud.probes['settled_chatter']:.3g} without, "
        f"{quiet.probes['settled_chatter']:.3g} with the guard, which holds A at "
        f"{-4.2 * factor:.3g}; the observer's index fell to {index[2]:.2f} and ends at "
        f"{index[1]:.2f}"
    )
    return holds(quiet.probes["settled_chatter"] < 0.02 * loud.probes["settled_chatter"], measured)


TORA = Group(
    "TORA",
    {
        **{
            key: Case("tora", key)
            for key in ("adaptive", "nonadaptive", "strong", "chatter", "guarded")
        },
        **{f"A={A:g}": _gain("tora", A) for A in SCAN},
    },
    (
        Claim(
            "3.2.2",
            "3.21-3.25, 3.27",
            "The increase of |A| considerably improves the tracking precision.",
            ("nonadaptive", "adaptive", "strong"),
            _precision,
        ),
        Claim(
            "3.2.2",
            "",
            "Between A = -3.23 and -3.235 strong chattering appears very quickly.",
            ("strong", "chatter"),
            _onset,
        ),
        Claim(
            "3.2.2",
            "3.26",
            "The driving arm moves alike in the adaptive and the non-adaptive case.",
            ("nonadaptive", "adaptive"),
            _insignificant,
        ),
        Claim(
            "1.1, [43]",
            "",
            "A simple model-independent observer sees precursor oscillations, so that convergence "
            "can be maintained.",
            ("chatter", "guarded"),
            _guarded,
        ),
    ),
    (
        Pictures(
            ("nonadaptive", "adaptive"),
            (
                "tracking",
                "tracking_error",
                "phase_trajectories",
                "responses",
                "responses_zoom",
                "uncontrolled",
            ),
        ),
        Pictures(("strong", "chatter", "guarded"), ("responses_zoom", "parameters")),
    ),
    responses,
)


def _calculated(runs: Outcomes) -> Verdict:
    auto, fixed, best = (runs[key].error() for key in ("adaptive", "fixed", "best"))
    p, small = runs["adaptive"].probes, runs["small_epsilon"].probes
    measured = (
        f"largest rms error {auto:.3g} with A in [{p['least_A']:.3g}, {p['greatest_A']:.3g}]; "
        f"fixed {fixed:.3g} (A = -0.1), {best:.3g} (A = -3.125)"
    )
    reason = (
        "epsilon is not too small: it decides how far |A| grows; with 1e-3 A reaches "
        f"{small['least_A']:.3g} and the control signal chatters "
        f"{small['settled_chatter'] / p['settled_chatter']:.3g} times as much"
    )
    return Verdict(ONLY_IF if auto < 0.2 * fixed else NO, measured, reason)


def _not_needed(runs: Outcomes) -> Verdict:
    lost = runs["large start"].lost
    measured = f"with a nominal amplitude of 1 rad the calculated gain is lost at {lost or 0:.2f} s"
    fixed = runs["large start, fixed"].error()
    reason = (
        "the initial error is small: A ||h|| = W limits the learning; fixed A = -0.1 gives "
        f"{fixed:.3g}"
    )
    return Verdict(ONLY_IF if lost else YES, measured, reason)


LARGE = ("trajectory_generator.amplitude=[0.3, 1.0]",)

AUTO = Group(
    "TORA with a calculated gain",
    {
        "adaptive": Case("tora_auto"),
        "small_epsilon": Case("tora_auto", "small_epsilon"),
        "nonadaptive": Case("tora", "nonadaptive"),
        "fixed": Case("tora"),
        "best": Case("tora", "strong"),
        "large start": Case("tora_auto", "adaptive", LARGE),
        "large start, fixed": Case("tora", "adaptive", LARGE),
    },
    (
        Claim(
            "3.3",
            "3.28-3.34",
            "A simple calculation of A replaces its tuning, and improves the precision.",
            ("adaptive", "fixed", "small_epsilon"),
            _calculated,
        ),
        Claim(
            "3.3.1",
            "",
            "It is enough that A ||h|| is somewhere between the two fixed points.",
            ("large start", "large start, fixed"),
            _not_needed,
        ),
    ),
    (
        Pictures(
            ("nonadaptive", "adaptive"),
            (
                "tracking",
                "tracking_error",
                "phase_trajectories",
                "responses",
                "responses_zoom",
                "uncontrolled",
                "parameters",
            ),
        ),
    ),
    gain,
)

GROUPS = (SISO, MIMO, NEURON, TORA, AUTO)
