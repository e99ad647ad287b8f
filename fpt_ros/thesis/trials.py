"""Trials of denoisers: one on a test signal, over several draws of the noise."""

import shlex
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from time import process_time

import numpy as np

from fpt_ros.analysis import style
from fpt_ros.denoising.noisy import Noisy
from fpt_ros.denoising.offline import DEFAULT, denoise
from fpt_ros.denoising.signals import Signal, rmse, snr_db
from fpt_ros.errors import BadInput
from fpt_ros.experiments.parameter_file import scalar
from fpt_ros.thesis.claim import Drawn
from fpt_ros.thesis.drawings import charts

SEEDS = range(10, 30)
"""Those that figures are reported of; constants were chosen on seeds 0 to 9."""

PEERS = ("bayesshrink", "visushrink", "soft_universal", "median_savgol", "lowess")
LABELS = {
    "bayesshrink": "scikit-image, BayesShrink",
    "visushrink": "scikit-image, VisuShrink",
    "soft_universal": "PyWavelets, soft, universal",
    "median_savgol": "median of 5, Savitzky-Golay (35, 3)",
    "lowess": "statsmodels, lowess of 61 samples",
    "auto": "auto (default)",
}
"""Methods of other libraries, and what tables call a method."""

NOTHING = np.empty(0)


@dataclass(frozen=True)
class Scores:
    """What a method did, a number a seed.

    Attributes:
        clean, noisy, estimate: of the first seed, shape (n,); the estimate is empty where there is
            none.
        snr: after denoising [dB], shape (seeds,).
        rmse: root mean square error, in the signal's unit.
        greatest: largest absolute error.
        missing: root mean square error over the missing samples alone; NaN where there are none.
        seconds: CPU time, one thread.
        reason: why there is nothing: a library is not installed.
        seeds: of the noise.
    """

    clean: Signal
    noisy: Signal
    estimate: Signal = field(default_factory=lambda: NOTHING)
    snr: Signal = field(default_factory=lambda: NOTHING)
    rmse: Signal = field(default_factory=lambda: NOTHING)
    greatest: Signal = field(default_factory=lambda: NOTHING)
    missing: Signal = field(default_factory=lambda: NOTHING)
    seconds: Signal = field(default_factory=lambda: NOTHING)
    reason: str = ""
    seeds: range = SEEDS

    def mean(self, name: str) -> float:
        """Over the seeds; NaN where there is nothing."""
        values = getattr(self, name)
        return float(np.mean(values)) if len(values) else float("nan")


@dataclass(frozen=True)
class Trial:
    """A method on a signal, for all ``seeds``; one of a claim's :class:`Evidence`."""

    noisy: Noisy
    method: str = DEFAULT
    settings: tuple[str, ...] = ()
    seeds: range = SEEDS

    @property
    def effort(self) -> float:
        """In units of a short run of an experiment."""
        return len(self.seeds) * (3.0 if self.method == DEFAULT else 0.5)

    def perform(self, key: str) -> Scores:
        """All seeds, after a first one that is not counted: it compiles."""
        options = {name: scalar(x) for name, _, x in (s.partition("=") for s in self.settings)}
        clean = self.noisy.clean()
        first = self.noisy.with_seed(self.seeds[0]).samples()
        try:
            estimate = denoise(first, self.method, **options).estimate  # type: ignore[arg-type]
        except BadInput as error:
            return Scores(clean, first, reason=str(error))
        rows = []
        for seed in self.seeds:
            y = self.noisy.with_seed(seed).samples()
            started = process_time()
            found = denoise(y, self.method, **options).estimate  # type: ignore[arg-type]
            took = process_time() - started
            largest = float(np.max(np.abs(found - clean)))
            gaps = np.isnan(y)
            filled = rmse(clean[gaps], found[gaps]) if gaps.any() else float("nan")
            rows.append((snr_db(clean, found), rmse(clean, found), largest, filled, took))
        snr, errors, greatest, missing, seconds = np.array(rows).T
        return Scores(
            clean, first, estimate, snr, errors, greatest, missing, seconds, seeds=self.seeds
        )

    def ending(self, result: Scores) -> str:
        """Why there are no scores."""
        return result.reason

    def command(self) -> str:
        """A loop of the shell over the seeds."""
        words = ["fpt", "denoise", self.noisy.text("XSEEDX"), "--method", self.method]
        for setting in self.settings:
            words += ["--set", setting]
        line = shlex.join(words).replace("XSEEDX", "$s")
        return f"for s in $(seq {self.seeds[0]} {self.seeds[-1]}); do {line}; done"


Results = Mapping[str, Scores]
"""The scores of a claim, by the keys under which it asks for them."""


def decibels(*values: float) -> list[str]:
    """SNR of a table."""
    return [f"{value:.2f}" if np.isfinite(value) else "–" for value in values]


def curves(results: Results, panels: Sequence[tuple[str, str]], rows: int = 1) -> Drawn:
    """Estimates over the signals: (key, title) a panel; an empty title: the noisy samples."""
    cells = []
    for key, title in panels:
        scores = results[key]
        t = np.arange(len(scores.clean)) / len(scores.clean)
        clean = (t, scores.clean, "signal", style.BAND)
        if title:
            shown = (t, scores.estimate, "estimate", style.thin(style.COORDINATES[0]))
            cells.append((title, "t", "", (clean, shown)))
        else:
            faint = {"color": style.COORDINATES[3], "linewidth": 0.7, "zorder": 1}
            cells.append(("with noise", "t", "", ((t, scores.noisy, "samples", faint), clean)))
    return charts(*cells, height=3.0 * rows, rows=rows)
