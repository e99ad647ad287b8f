"""Section 5.1.1: missing samples."""

from fpt_ros.denoising.noisy import Noisy
from fpt_ros.thesis.claim import NO, ONLY_IF, YES, Claim, Table, Verdict
from fpt_ros.thesis.trials import Results, Scores, Trial

GAPS = {"periodic": "periodic", "doppler": "doppler", "sines": "aperiodic sines"}
SHARES = (0.1, 0.4)
FILLERS = ("nearest", "thesis", "linear", "rehearsal")


def _heals(results: Results) -> Verdict:
    rms = {
        (s, x, f): results[f"{s}, {x:g}, {f}"].mean("missing")
        for s in GAPS
        for x in SHARES
        for f in FILLERS
    }
    worse = [
        s for s in GAPS if any(rms[s, x, "thesis"] > 1.5 * rms[s, x, "nearest"] for x in SHARES)
    ]
    gain = min(rms["periodic", x, "nearest"] / rms["periodic", x, "thesis"] for x in SHARES)
    best = all(
        rms[s, x, "rehearsal"] <= 1.1 * min(rms[s, x, f] for f in FILLERS) for s, x, _ in rms
    )
    rows = tuple(
        (f"{GAPS[s]}, {x:.0%} missing", *(f"{rms[s, x, f]:.4f}" for f in FILLERS))
        for s in GAPS
        for x in SHARES
    )
    return Verdict(
        ONLY_IF if worse and gain > 1.0 else YES if gain > 1.0 else NO,
        {
            "periodic: error, nearest neighbour / by period, at least": gain,
            "aperiodic: error, by period / nearest neighbour": rms["sines", 0.1, "thesis"]
            / rms["sines", 0.1, "nearest"],
        },
        "Only if the signal is periodic: on others false periods are found, and the healing is "
        "worse than the nearest neighbour. The rehearsal, which tries the fillers where the "
        f"samples are known, is {'the best, or nearly so, on all' if best else 'not always best'}.",
        Table(
            ("rms error on the missing samples", "nearest", "thesis", "linear", "rehearsal"), rows
        ),
    )


CLAIMS: tuple[Claim[Scores], ...] = (
    Claim(
        "5.1.1",
        "",
        "Anytime auto-healing, by period or nearest neighbour, recovers signals from incomplete "
        "data.",
        {
            f"{s}, {x:g}, {f}": Trial(
                Noisy(s, rho=0.0, snr=26.0, missing=x), "anytime", (f"filler={f}",)
            )
            for s in GAPS
            for x in SHARES
            for f in FILLERS
        },
        _heals,
    ),
)
