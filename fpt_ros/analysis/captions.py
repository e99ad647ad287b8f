"""What there is to see in each figure, and which figure of the thesis it corresponds to."""

from collections.abc import Sequence
from dataclasses import dataclass

from fpt_ros.runs.run import Run


@dataclass(frozen=True)
class Caption:
    """Title of a figure and what to see in it."""

    title: str
    text: str


CAPTIONS = {
    "tracking": Caption(
        "Trajectory tracking",
        "Nominal trajectory (broad band) and realised motion (line), per controlled coordinate. "
        "Where tracking is good the line runs inside the band.",
    ),
    "tracking_error": Caption(
        "Tracking error",
        "Nominal minus realised position. The error counts as "
        "settled to the right of the shaded time; its rms there stands above each panel.",
    ),
    "errors_together": Caption(
        "Tracking errors on top of each other",
        "The same errors, those of all runs in one panel per coordinate: where one run covers "
        "another they do not differ.",
    ),
    "phase_trajectories": Caption(
        "Phase trajectories",
        "Velocity over position, nominal (broad band) and realised (line), from the initial state "
        "on. A precise controller closes the loop on the band.",
    ),
    "responses": Caption(
        "Desired, deformed and realised response",
        "What the kinematic prescription wants (broad band), what the model is asked for instead "
        "(dashed), and what the plant then does (line). Adaptation works where the line stays "
        "inside the band while the dashed curve differs from both; without deformation the dashed "
        "curve is the desired response itself.",
    ),
    "responses_zoom": Caption(
        "Desired, deformed and realised response, excerpt",
        "The same about the settle time, for half a period of the nominal motion.",
    ),
    "forces": Caption(
        "Forces",
        "Generalised forces that the approximate model gives for the deformed response.",
    ),
    "uncontrolled": Caption(
        "Coordinates that are not controlled",
        "Motion of the coordinates that no nominal trajectory is given for: what the dynamic "
        "coupling makes them do while the others are controlled.",
    ),
    "spectra": Caption(
        "Spectra before and after the denoiser",
        "Amplitude density of the measured position (broad) and of the position that the denoiser "
        "makes of it (line), over the whole run (Welch, segments of 4096 cycles); both scales "
        "logarithmic. Noise is where the broad line is flat; what the denoiser takes away lies "
        "between the two.",
    ),
    "parameters": Caption(
        "Tuned parameters",
        "What is tuned over time, and (dashed) the values that the exact parameters of the plant "
        "would give it, where there are such. precursor: index of the precursor observer, 1 for "
        "a response that is smooth from cycle to cycle, below 0 where it oscillates; gain_factor: "
        "what the guard leaves of the gain.",
    ),
    "latency": Caption(
        "Latency in real time",
        "Cycles by the time from the sensor's message to the command for it, on bins of equal "
        "ratio, both scales logarithmic. A deadline is missed where a cycle (dt, the deadline) "
        "ends without its command; commands that come later still are counted here, those that "
        "never come are not.",
    ),
}
"""By the figure's name, in the order of the page."""

_THESIS: dict[str, dict[str, str]] = {
    "vdp_aidc": {"tracking_error": "2.1", "parameters": "2.3, 2.4"},
    "vdp_modified": {"tracking_error": "2.5, 2.8", "parameters": "2.6, 2.7, 2.9"},
    "vdp_rfpt": {"tracking_error": "2.10", "parameters": "2.11", "phase_trajectories": "2.12"},
    "cart_beam_hamper": {
        "tracking_error": "2.13, 2.15",
        "parameters": "2.14, 2.16",
        "phase_trajectories": "2.17",
        "tracking": "2.18",
        "responses": "2.19",
        "responses_zoom": "2.19",
    },
    "coupled_masses": {
        "tracking": "2.20, 2.21",
        "tracking_error": "2.22, 2.23",
        "phase_trajectories": "2.24, 2.25",
        "parameters": "2.28-2.31",
        "responses": "2.32, 2.33",
    },
    "siso_affine": {"responses": "3.4-3.7"},
    "mimo_affine": {"responses": "3.20"},
    "fitzhugh_nagumo": {
        "tracking": "3.8, 3.14",
        "tracking_error": "3.9, 3.15",
        "phase_trajectories": "3.10, 3.16",
        "responses": "3.12, 3.18",
        "forces": "3.13, 3.19",
    },
    "tora": {
        "tracking": "3.21",
        "tracking_error": "3.22",
        "phase_trajectories": "3.23",
        "responses": "3.24",
        "responses_zoom": "3.25",
        "uncontrolled": "3.26",
    },
    "tora_auto": {
        "tracking": "3.28",
        "tracking_error": "3.29",
        "phase_trajectories": "3.30",
        "responses": "3.31",
        "responses_zoom": "3.32",
        "uncontrolled": "3.33",
        "parameters": "3.34",
    },
    "swing": {"tracking": "4.3, 4.4", "responses_zoom": "4.5, 4.6"},
    "kapitza": {
        "tracking": "4.10, 4.11",
        "tracking_error": "4.10, 4.11",
        "responses": "4.12",
        "responses_zoom": "4.13",
        "forces": "4.14, 4.15",
    },
    "spherical_pendulum": {
        "tracking": "4.16, 4.17",
        "tracking_error": "4.16, 4.17",
        "responses": "4.18",
        "parameters": "4.19",
    },
}
"""Experiment -> figure -> figures of the thesis, for the base and the variants not named below."""

_SOFT = {
    "fuzzy_sin": ("4.21, 4.22", "4.23", "4.24"),
    "fully_fuzzy": ("4.25, 4.26", "4.27", "4.28"),
}

_VARIANTS: dict[tuple[str, str], dict[str, str]] = {
    ("tora", "strong"): {"responses_zoom": "3.27"},
    ("tora", "chatter"): {},
    **{
        ("spherical_pendulum", model + suffix): {
            "tracking": tracking,
            "tracking_error": tracking,
            "responses": responses,
            "parameters": parameters,
        }
        for model, (tracking, responses, parameters) in _SOFT.items()
        for suffix in ("", "_nonadaptive")
    },
}


def thesis_figures(name: str, runs: Sequence[Run]) -> str:
    """The thesis's counterparts of a figure of these runs, as ``Fig. 3.22``; empty: none."""
    found: dict[str, list[str]] = {}
    for run in runs:
        experiment, variant = run.info.get("experiment", ""), run.info.get("variant", "")
        by_name = _VARIANTS.get((experiment, variant), _THESIS.get(experiment, {}))
        numbers = found.setdefault(experiment, [])
        numbers += [n for n in by_name.get(name, "").split(", ") if n and n not in numbers]
    texts = []
    for experiment, numbers in found.items():
        if numbers:
            word = "Fig." if len(numbers) == 1 and "-" not in numbers[0] else "Figs"
            where = f"{experiment}: " if len(found) > 1 else ""
            texts.append(f"{where}{word} {', '.join(numbers)}")
    return "; ".join(texts)
