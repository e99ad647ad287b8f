"""Sections 4.3.4 and 4.3.5: the spherical pendulum with fuzzy models."""

import math

import numpy as np

from fpt_ros.analysis import style
from fpt_ros.plants import spherical_pendulum
from fpt_ros.runs.run import Array
from fpt_ros.thesis import drawings as draw
from fpt_ros.thesis.chapter4.s4_3_3_affine_model import model_pair, model_pictures
from fpt_ros.thesis.claim import NO, YES, Claim, Drawn, Picture, Verdict
from fpt_ros.thesis.judges import precise
from fpt_ros.thesis.setup import Runs


def _fuzzy_functions(runs: Runs) -> Verdict:
    x = np.linspace(0.0, math.pi, 2001)
    apart = {
        "sin": np.abs(np.sin(x) - _fuzzy(spherical_pendulum.SINES, x)).max(),
        "cos": np.abs(np.cos(x) - _fuzzy(spherical_pendulum.COSINES, x)).max(),
    }
    return Verdict(
        YES if max(apart.values()) < 0.1 else NO,
        {f"largest difference from {name} over [0, pi]": float(x) for name, x in apart.items()},
        "Five triangular sets over [0, pi].",
    )


def _fuzzy(singletons: tuple[float, ...], x: Array) -> Array:
    return np.array([spherical_pendulum.fuzzy(singletons, float(value)) for value in x])


def fuzzy_figure(runs: Runs) -> Drawn:
    """Sine and cosine, exact and by fuzzy rules."""
    x = np.linspace(0.0, math.pi, 400)
    curves = (
        (x, np.sin(x), "sin", {"color": style.INK, "linewidth": 1.3}),
        (x, _fuzzy(spherical_pendulum.SINES, x), "fuzzy sin", style.thin(style.COORDINATES[0])),
        (x, np.cos(x), "cos", style.thin(style.COORDINATES[1])),
        (x, _fuzzy(spherical_pendulum.COSINES, x), "fuzzy cos", style.thin(style.DEFORMED)),
    )
    return draw.charts(("sin, cos and their fuzzy approximations", "x [rad]", "", curves))


CLAIMS = (
    Claim(
        "4.3.4",
        "4.20",
        "Fuzzy rules approximate sin and cos over a bounded region.",
        {},
        _fuzzy_functions,
        (Picture("4.20", "Fuzzy functions", fuzzy_figure),),
    ),
    Claim(
        "4.3.4",
        "4.21-4.24",
        "With the fuzzy sine in the inertia matrix the adaptive controller is precise, the "
        "non-adaptive one is not.",
        model_pair("fuzzy sine"),
        precise("adaptive", "nonadaptive", 100.0),
        model_pictures("4.21, 4.22", "4.23", "4.24"),
    ),
    Claim(
        "4.3.5",
        "4.25-4.28",
        "With sine and cosine fuzzy in every term (fully soft computing-based model) the "
        "adaptive controller is precise.",
        model_pair("fully fuzzy"),
        precise("adaptive", "nonadaptive", 100.0),
        model_pictures("4.25, 4.26", "4.27", "4.28"),
    ),
)
