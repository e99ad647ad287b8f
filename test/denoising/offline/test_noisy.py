"""Words for test signals, and the trials that claims make of them."""

import math

import numpy as np
import pytest

from fpt_ros.denoising import signals
from fpt_ros.denoising.noisy import Noisy, parse
from fpt_ros.denoising.offline import denoise
from fpt_ros.errors import BadInput
from fpt_ros.thesis.trials import Trial


@pytest.mark.parametrize(
    "noisy",
    [
        Noisy("sines"),
        Noisy("blocks", seed=3, rho=0.9, n=256),
        Noisy("periodic", rho=0.0, snr=26.0, missing=0.1),
        Noisy("chirp", sigma=0.2),
        Noisy("twotone", seed=7, sigma=0.1, spikes=1),
    ],
)
def test_a_word_gives_the_signal_that_it_is_of(noisy):
    again = parse(noisy.text())
    assert again == noisy
    np.testing.assert_array_equal(again.samples(), noisy.samples())


def test_noise_is_that_of_table_51():
    noisy = Noisy("doppler", seed=4)
    f, y = noisy.clean(), noisy.samples()
    assert signals.snr_db(f, y) == pytest.approx(2.2294, abs=1e-9)
    np.testing.assert_array_equal(y, f + signals.impulsive_noise(f, 0.5, 4))


def test_missing_samples_are_not_numbers():
    y = Noisy("sines", missing=0.25, n=4096).samples()
    assert np.isnan(y).mean() == pytest.approx(0.25, abs=0.03)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("test:sinus", "test signals are sines, doppler"),
        ("test:sines,sigma=1", "sines takes rho, snr, seed"),
        ("test:chirp,rho=0.5", "chirp takes sigma, spikes, seed"),
        ("test:sines,seed=1.5", "seed=1.5 is not a whole number"),
        ("test:sines,rho=x", "rho=x is not a number"),
        ("test:sines,rho=1.5", "rho lies between 0.0 and 1.0"),
        ("test:sines,n=1", "n lies between 2"),
        ("test:sines,missing=1", "missing lies between"),
    ],
)
def test_bad_words(text, message):
    with pytest.raises(BadInput, match=message):
        parse(text)


def test_a_trial_scores_what_denoise_does():
    trial = Trial(Noisy("heavisine", rho=0.9), "improved", ("detail=zero",), range(40, 43))
    scores = trial.perform("")
    expected = []
    for seed in range(40, 43):
        f = signals.clean("heavisine")
        y = f + signals.impulsive_noise(f, 0.9, seed)
        expected.append(signals.snr_db(f, denoise(y, "improved", detail="zero").estimate))
    assert scores.snr == pytest.approx(expected)
    assert scores.mean("snr") == pytest.approx(np.mean(expected))
    assert trial.ending(scores) == ""
    assert trial.command() == (
        "for s in $(seq 40 42); do fpt denoise test:heavisine,rho=0.9,seed=$s --method improved "
        "--set detail=zero; done"
    )


def test_a_trial_of_what_is_not_there_says_why(monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "skimage.restoration", None)
    trial = Trial(Noisy("sines"), "bayesshrink")
    scores = trial.perform("")
    assert trial.ending(scores) == "skimage is not installed: pip install 'fpt_ros[peers]'"
    assert math.isnan(scores.mean("snr"))


# --- peers: the libraries do what their documentation says


def test_soft_universal_is_the_rule_of_chapter_5():
    """PyWavelets' own threshold and ours are the same mathematics."""
    y = Noisy("sines").samples()
    ours = denoise(y, "universal", level=5).estimate
    theirs = denoise(y, "soft_universal", level=5).estimate
    # HeurSure's library bound takes the length of the signal, as ours does
    assert signals.rmse(ours, theirs) < 0.02


@pytest.mark.parametrize("peer", ["bayesshrink", "visushrink", "median_savgol", "lowess"])
def test_peers_denoise_what_they_are_made_for(peer):
    noisy = Noisy("twotone", sigma=0.2) if "shrink" in peer else Noisy("heavisine", rho=0.5)
    f, y = noisy.clean(), noisy.samples()
    assert signals.rmse(f, denoise(y, peer).estimate) < 0.5 * signals.rmse(f, y)


def test_peers_refuse_what_is_no_wavelet():
    with pytest.raises(BadInput, match="'sym99' is none of PyWavelets"):
        denoise(Noisy("sines").samples(), "visushrink", wavelet="sym99")
