"""Section 5.2: the parameters of the fitting, determined on line by the fuzzy supervisor."""

from collections.abc import Mapping

from fpt_ros.runs.run import Run
from fpt_ros.thesis import drawings as draw
from fpt_ros.thesis.chapter7.loops import COLUMNS, LOOP, NOISE, table_cells
from fpt_ros.thesis.claim import NO, ONLY_IF, YES, Claim, Picture, Table, Verdict
from fpt_ros.thesis.measures import complete, settled_rms
from fpt_ros.thesis.setup import Runs, Setup
from fpt_ros.thesis.words import because, listed

FUZZY, SHORT, LONG, WAVELET = (
    "fuzzy supervisor, 11 to 41",
    "window of 31",
    "window of 41",
    "wavelet",
)
FILTERS: Mapping[str, Setup] = {
    FUZZY: Setup(LOOP, "fuzzy"),
    SHORT: Setup(LOOP, "savgol"),
    LONG: Setup(LOOP, "savgol", ("denoiser.window=41",)),
    WAVELET: Setup(LOOP, "wavelet"),
}
IMPULSES = "noise of 0.0001 and impulses"
_SENSORS = "plant_simulator.sensors"
SENSORS: Mapping[str, tuple[str, ...]] = {
    "noise of 0.00001": (f"{NOISE}=1e-5",),
    "noise of 0.0001": (f"{NOISE}=1e-4",),
    "noise of 0.001": (f"{NOISE}=1e-3",),
    IMPULSES: (
        f"{NOISE}=1e-4",
        f"{_SENSORS}.kinds=[impulses]",
        f"{_SENSORS}.impulses.size=0.01",
        "denoiser.healing.kind=none",
    ),
}


def _key(name: str, sensors: str) -> str:
    return f"{name}, {sensors}"


def _setup(name: str, sensors: str) -> Setup:
    setup = FILTERS[name]
    return Setup(setup.name, setup.variant, (*setup.settings, *SENSORS[sensors]))


def _determined(runs: Runs) -> Verdict:
    error = {(f, s): settled_rms(runs[_key(f, s)], "q3") for f in FILTERS for s in SENSORS}
    ratio = {s: error[FUZZY, s] / min(error[SHORT, s], error[LONG, s]) for s in SENSORS}
    better = [s for s, x in ratio.items() if x < 1.0]
    worse = [s for s in SENSORS if s not in better]
    held = all(complete(runs[_key(FUZZY, s)]) for s in SENSORS)
    quiet = "noise of 0.0001"
    rows = tuple((key, *table_cells(run)) for key, run in runs.items())
    return Verdict(
        NO if not better or not held else ONLY_IF if worse else YES,
        {
            **{f"q3, fuzzy / better fixed window, {s}": x for s, x in ratio.items()},
            f"q3, wavelet / window of 31, {quiet}": error[WAVELET, quiet] / error[SHORT, quiet],
            f"q3, window of 41 / fuzzy, {quiet}": error[LONG, quiet] / error[FUZZY, quiet],
        },
        because(
            bool(better) and held,
            "Only of the fit, for wavelet and level have nothing to choose at the newest sample: "
            "shrinkage gains nothing there. The expert chooses the window at every sample, and "
            f"tracks better than the better of two fixed windows with {listed(better)}"
            + (f"; worse with {listed(worse)}" if worse else "")
            + ". It judges by the estimate: where that asks for a wide window, it takes one "
            "that is too slow for the loop, unless the widest is limited.",
        ),
        Table(("loop; seed 1", *COLUMNS), rows),
    )


CLAIMS: tuple[Claim[Run], ...] = (
    Claim(
        "5.2",
        "",
        "The wavelet function, the level of decomposition and the parameters of the fitting are "
        "determined on line by the fuzzy supervisory expert.",
        {_key(f, s): _setup(f, s) for f in FILTERS for s in SENSORS},
        _determined,
        (
            Picture(
                "",
                "Tracking error with noise of 0.0001 and impulses",
                draw.errors(*(_key(name, IMPULSES) for name in (SHORT, WAVELET, FUZZY))),
            ),
        ),
    ),
)
