"""The filters' one source: in Python on lists and mapped memory, and compiled, to the same bits."""

import math

import numpy as np
import pytest
from filter_runs import noise, run, two_sines

from fpt_ros.denoising.streaming import FILTERS, Update
from fpt_ros.denoising.streaming.adaptive_savgol import ADAPTIVE_SAVGOL
from fpt_ros.denoising.streaming.kalman_bank import KALMAN_BANK
from fpt_ros.denoising.streaming.savgol import SAVGOL
from fpt_ros.denoising.streaming.wavelet import WAVELET
from fpt_ros.engine import compiled

PEERS = ("alpha_beta_gamma", "butterworth", "high_gain", "levant", "one_euro")

LAWS = {
    "kalman_bank": (KALMAN_BANK, {}),
    "fuzzy": (FILTERS["fuzzy"], {"windows": [7.0, 41.0], "noise_window": 31}),
    "savgol": (SAVGOL, {"window": 41, "degree": 3}),
    "adaptive_savgol": (ADAPTIVE_SAVGOL, {"windows": [21.0, 41.0, 71.0], "degrees": [2, 3, 5]}),
    "kalman_bank, given": (KALMAN_BANK, {"sigma": 1e-3, "settling": 0.1}),
    "wavelet": (WAVELET, {"window": 64, "level": 2, "fit": 31}),
    **{name: (FILTERS[name], {}) for name in PEERS},
}


def rough():
    """Two coordinates with noise, impulses, a step, and missing samples."""
    q = np.column_stack([two_sines(400)[0] + noise(400), 50.0 + noise(400, seed=1)])
    q[[150, 151, 260], 0] += 0.5
    q[200:, 1] += 3.0
    q[300, :] = math.nan
    q[310, 1] = math.inf
    return q


def mapped_vector(values):
    return memoryview(np.array(values, dtype=float)).cast("B").cast("d")


@pytest.mark.parametrize("name", LAWS)
def test_same_bits_in_python_and_compiled(name):
    law, given = LAWS[name]
    machine = compiled.law(law.update, Update)
    python = run(law, rough(), **given)
    arrays = run(law, rough(), vector=lambda x: np.array(x, dtype=float), update=machine, **given)
    mapped = run(law, rough(), vector=mapped_vector, **given)
    assert np.isfinite(python[250]).all()
    assert python.tobytes() == arrays.tobytes()
    assert python.tobytes() == mapped.tobytes()
