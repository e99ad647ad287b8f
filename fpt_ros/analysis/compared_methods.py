"""All methods on one signal: what each leaves over, and how long it takes."""

from time import process_time

import numpy as np

from fpt_ros.analysis.estimates import Estimate, estimate
from fpt_ros.analysis.signal_source import Source
from fpt_ros.denoising.offline import DENOISERS
from fpt_ros.denoising.signals import rmse, snr_db
from fpt_ros.errors import BadInput
from fpt_ros.tables.table import Column

Row = dict[str, str | float]


def success(source: Source, found: Estimate) -> dict[str, float]:
    """How near to the clean signal, where that is known."""
    if source.clean is None:
        return {}
    there = ~found.healed
    return {
        "snr_before": snr_db(source.clean[there], found.measured[there]),
        "snr_after": snr_db(source.clean, found.estimate),
        "rmse": rmse(source.clean, found.estimate),
    }


def compare(source: Source, signal: Column) -> list[Row]:
    """A row a method; one that cannot take the signal has the key ``error`` instead of numbers."""
    rows: list[Row] = []
    for name in DENOISERS.names():
        started = process_time()
        try:
            found = estimate(source, signal, name, {})
        except BadInput as error:
            rows.append({"method": name, "error": str(error)})
            continue
        seconds = process_time() - started
        residual = found.residual
        rough = float(np.sqrt(np.mean(np.diff(found.result.estimate, 2) ** 2)))
        rows.append(
            {
                "method": name,
                **success(source, found),
                "sigma": found.result.sigma,
                "residual_rms": float(np.sqrt(np.nanmean(residual**2))),
                "residual_median": float(np.nanmedian(np.abs(residual))) / 0.6745,
                "roughness": rough,
                "cpu_time": seconds,
            }
        )
    return rows
