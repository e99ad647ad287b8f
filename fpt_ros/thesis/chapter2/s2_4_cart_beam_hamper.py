"""Sections 2.4.1 and 2.4.5: cart, beam and hamper; Slotine-Li, and RFPT without friction."""

from fpt_ros.thesis import drawings as draw
from fpt_ros.thesis.claim import NO, ONLY_IF, YES, Claim, Picture, Verdict
from fpt_ros.thesis.judges import precise
from fpt_ros.thesis.learning import coefficient_table, coefficients, learned
from fpt_ros.thesis.measures import settled_rms
from fpt_ros.thesis.setup import Runs, Setup

CART = "cart_beam_hamper"


def _similarly_tuned(runs: Runs) -> Verdict:
    without, with_it = (coefficients(runs[key]) for key in ("no RFPT", "RFPT"))
    apart = {
        name: abs(with_it[name][1] - x) / abs(x - start) for name, (start, x, _) in without.items()
    }
    gone = {name: learned(*found) for name, found in with_it.items()}
    similar = max(apart.values()) < 0.5
    return Verdict(
        YES if similar else ONLY_IF if min(apart.values()) < 0.5 else NO,
        {f"{name}, ends apart by this part of its way": x for name, x in apart.items()},
        f"With and without RFPT they end within {max(apart.values()):.2%} of the way that they go "
        f"in 30 s, on which {min(gone.values()):.0%} to {max(gone.values()):.0%} of their error "
        "is taken away.",
        coefficient_table({"no RFPT": runs["no RFPT"], "RFPT": runs["RFPT"]}),
    )


def _slotine_li(runs: Runs) -> Verdict:
    quiet, loud = (settled_rms(runs[key], "q3") for key in ("no friction", "friction"))
    best = settled_rms(runs["RFPT, friction"], "q3")
    return Verdict(
        YES if loud > 2.0 * quiet else NO,
        {
            "q3, rms error, no friction [m]": quiet,
            "q3, rms error, friction [m]": loud,
            "q3, rms error, modified tuning and RFPT, friction [m]": best,
            "q3, rms error, neither, friction [m]": settled_rms(runs["neither, friction"], "q3"),
        },
        f"Friction at axle 3 makes its error {loud / quiet:.3g} times as large, larger than "
        f"without any tuning; the modified controller with RFPT is {loud / best:.3g} times as "
        "precise."
        if loud > settled_rms(runs["neither, friction"], "q3")
        else f"Friction at axle 3 makes its error {loud / quiet:.3g} times as large; the modified "
        f"controller with RFPT is {loud / best:.3g} times as precise.",
    )


CLAIMS = (
    Claim(
        "2.4.1",
        "",
        "The adaptive Slotine-Li controller cannot properly compensate unknown disturbances and "
        "friction.",
        {
            "no friction": Setup(CART, "slotine_li"),
            "friction": Setup(CART, "slotine_li_lugre"),
            "neither, friction": Setup(CART, "fixed_model_lugre"),
            "RFPT, friction": Setup(CART, "lugre"),
        },
        _slotine_li,
        (Picture("", "Tracking error, Slotine-Li", draw.errors("no friction", "friction")),),
    ),
    Claim(
        "2.4.5",
        "2.13",
        "Without disturbances RFPT considerably improves the tracking precision of the modified "
        "tuning.",
        {
            "neither": Setup(CART, "fixed_model"),
            "no RFPT": Setup(CART, "no_rfpt"),
            "RFPT": Setup(CART),
            "RFPT alone": Setup(CART, "fixed_model_rfpt"),
        },
        precise(
            "RFPT",
            "no RFPT",
            10.0,
            "RFPT alone, with the model as it was, is at least as precise: tuning and RFPT "
            "coexist, but the precision is RFPT's.",
            ("neither", "RFPT alone"),
        ),
        (Picture("2.13", "Tracking error", draw.errors("no RFPT", "RFPT")),),
    ),
    Claim(
        "2.4.5",
        "2.14",
        "The initially strongly over-estimated parameters are tuned in a similar manner with and "
        "without RFPT.",
        {"no RFPT": Setup(CART, "no_rfpt"), "RFPT": Setup(CART)},
        _similarly_tuned,
        (Picture("2.14", "Tuning of the parameters", draw.parameters("no RFPT", "RFPT")),),
    ),
)
