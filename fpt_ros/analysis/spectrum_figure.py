"""The figure of the denoiser's work: spectra of positions before and after it."""

from collections.abc import Sequence

import numpy as np

from fpt_ros.analysis import signals, style
from fpt_ros.analysis.labels import all_names, colour_of
from fpt_ros.analysis.outline import Outline, outline
from fpt_ros.analysis.panels import Panels
from fpt_ros.analysis.spectra import Spectrum
from fpt_ros.runs.run import Run

MEASURED: style.Style = {"color": style.WANTED, "linewidth": 1.6, "zorder": 2}

DECADES = 12
"""Below the largest amplitude, what is drawn at most: rounding stands lower."""


def spectra(runs: Sequence[Run]) -> Panels | None:
    """Amplitude densities of measured and of denoised positions, of runs with a denoiser."""
    outlines = [one for one in map(outline, runs) if one.spectra]
    rows = all_names(outlines, _denoised)
    if not rows:
        return None
    panels = Panels.of(outlines, rows, time=False, logarithmic=True)
    for name, column, run in panels.cells(outlines):
        found = run.spectra.get(name)
        panel = None if found is None else panels.take(name, column, found.before)
        if found is None or panel is None:
            continue
        panel.draw(found.frequency, found.before, MEASURED, "measured")
        panel.draw(found.frequency, found.after, style.thin(colour_of(run, name)), "denoised")
        unit = signals.unit(run, name)
        panel.x_label = "frequency [Hz]"
        panel.y_label = style.label(f"amplitude of {style.symbol(name)}", unit or "1", "√Hz")
    for name in rows:
        drawn = [run.spectra[name] for run in outlines if name in run.spectra]
        for column, _ in enumerate(outlines):
            if (name, column) in panels.taken:
                panel = panels.taken[name, column]
                panel.x_span, panel.y_span = _spans(drawn)
    return panels.finish("measured", "denoised")


def _denoised(run: Outline) -> list[str]:
    return [name for name, one in run.spectra.items() if one.before.any()]


def _spans(found: Sequence[Spectrum]) -> tuple[tuple[float, float], tuple[float, float]]:
    """Of frequency and amplitude, for all runs."""
    x = min(one.frequency[0] for one in found), max(one.frequency[-1] for one in found)
    amplitudes = np.concatenate([each for one in found for each in (one.before, one.after)])
    top = float(amplitudes.max(initial=0.0)) or 1.0
    seen = amplitudes[amplitudes > top * 10.0**-DECADES]
    return (float(x[0]), float(x[1])), (float(seen.min(initial=top)) / 2.0, 2.0 * top)
