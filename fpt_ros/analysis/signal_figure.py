"""The picture of a denoised signal: measured, healed, estimated, and what was taken away."""

import io

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from fpt_ros.analysis import style
from fpt_ros.analysis.signal_source import Source
from fpt_ros.denoising.offline import Result


def picture(source: Source, result: Result, kind: str) -> bytes:
    """The picture as the bytes of a file of this kind (png, svg, pdf)."""
    samples = np.arange(len(source.values), dtype=np.float64)
    with style.settings():
        figure = Figure(figsize=(9.0, 5.2), layout="constrained")
        FigureCanvasAgg(figure)
        above, below = figure.subplots(2, 1, sharex=True, height_ratios=(2.2, 1.0))
        above.plot(samples, source.values, color=style.WANTED, linewidth=0.9, label="measured")
        healed = result.healed
        above.plot(samples, result.estimate, color=style.COORDINATES[0], label="estimate")
        if healed.any():
            dots = {"linestyle": "", "marker": "o", "markersize": 3.5}
            above.plot(
                samples[healed],
                result.estimate[healed],
                color=style.DEFORMED,
                label=f"healed ({healed.sum()})",
                **dots,
            )
        above.set_title(style.plain(f"{source.name}: {result.method}"), loc="left")
        above.legend(loc="upper right", ncols=3)
        below.plot(samples, source.values - result.estimate, color=style.INK, linewidth=0.8)
        for limit in (-2.0 * result.sigma, 2.0 * result.sigma):
            below.axhline(limit, color=style.WANTED, linewidth=0.9, linestyle="--")
        below.set_ylabel("residual")
        below.set_xlabel("sample; dashed: two standard deviations of the noise")
        buffer = io.BytesIO()
        figure.savefig(buffer, format=kind)
    return buffer.getvalue()
