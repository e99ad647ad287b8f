"""Arms where it gets difficult: gains at the onset of chatter, and noise of positions alone."""

import math

import numpy as np
import pytest
from engine_runs import run

from fpt_ros.analysis.metrics import summary
from fpt_ros.experiments.experiment import load
from fpt_ros.gain.contraction import bounds
from fpt_ros.runs.run import Run, describe

pytest.importorskip("mujoco")

SIGMA, DT = 1e-5, 1e-3


def judged(variant, *settings, arm="panda", duration=None):
    """Settled rms over all joints [rad], noise taken out, and mean |change of effort| [N m]."""
    loaded = load(arm, variant, settings, duration)
    topics = run(loaded)
    found = summary(Run(describe(loaded, "in_process", ""), loaded.nodes, topics))["tracking"]
    rms = math.sqrt(np.mean([joint["rms_settled"] ** 2 for joint in found.values()]))
    command = topics["command"]
    late = command.vectors["effort"][command.time >= loaded.about["settle_time"]]
    return rms, float(np.abs(np.diff(late, axis=0)).mean())


WIDE = ("fpt_deformer.scale=100.0",)


@pytest.mark.parametrize(
    ("variant", "settings"),
    [("adaptive", WIDE), ("adaptive", ("fpt_deformer.form=signed",)), ("rfpt", ())],
    ids=["norm", "signed", "rfpt"],
)
def test_chatter_sets_in_at_two_over_the_largest_eigenvalue(variant, settings):
    """Within 15 %, where the sigmoid is wide: with S = 10 a finite two-cycle comes before."""
    bound = bounds(load("panda", variant, settings))
    onset = math.copysign(bound.bare_limit, bound.sign)
    assert abs(onset * bound.slope) == pytest.approx(2.0 / bound.eigenvalues[1])
    quiet, loud = (
        judged(variant, *settings, f"fpt_deformer.A={part * onset}", duration=3.5)[1]
        for part in (0.85, 1.15)
    )
    assert quiet < 0.02
    assert loud > 5.0 * quiet


def test_noise_of_positions_alone():
    rms, chatter = judged("noisy_jerk")
    assert rms <= 1.2e-3
    assert chatter <= 0.1


def filtered(states, w):
    """A Kalman filter with this bandwidth [1/s]."""
    density = w ** (2 * states) * SIGMA**2 * DT
    return f"denoiser.states=[{states}.0]", f"denoiser.densities=[{density}]"


def test_the_curve_of_error_against_chatter_is_below_the_momentum_observers():
    """The observer's best settings of 80 (bandwidth of its filter, gain), and one of ours each."""
    observer = (
        "fpt_deformer.transformation=none",
        "fpt_deformer.synchronised=false",
        "fpt_deformer.compensator.kind=momentum_observer",
    )
    pairs = {
        (170.0, 150.0): (70.0, 1.5),
        (250.0, 250.0): (100.0, 2.0),
        (300.0, 400.0): (120.0, 3.0),
    }
    for (w, gain), (ours_w, g) in pairs.items():
        given = f"fpt_deformer.compensator.gain={gain}"
        theirs = judged("noisy", *filtered(3, w), *observer, given)
        ours = judged("noisy_jerk", *filtered(4, ours_w), f"fpt_deformer.A={-1.58 * g}")
        assert ours[0] < 0.6 * theirs[0]
        assert ours[1] < 1.05 * theirs[1]


def test_weights_make_up_for_a_model_without_armature():
    """Half of the links' inertia alone: the wrist's eigenvalues fall to a tenth of the others."""
    without = ("fpt_deformer.approximate.armature=0.0", *WIDE)
    alike = judged("adaptive", *without)[0]
    weighted = judged("adaptive", *without, "fpt_deformer.weights=auto", "fpt_deformer.A=-1.42")[0]
    assert weighted < 1.4e-4
    assert weighted < 0.1 * alike
