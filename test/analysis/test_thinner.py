import numpy as np
import pytest

from fpt_ros.analysis.thinner import CAPACITY, Thinner, Window


def taken(signals, size, near=None):
    thinner = Thinner(len(signals), near)
    count = len(signals[0])
    time = 0.001 * np.arange(count)
    for first in range(0, count, size):
        part = slice(first, first + size)
        thinner.take(time[part], *[signal[part] for signal in signals])
    return thinner


@pytest.fixture(scope="module")
def long():
    """Chatter about a slow motion, with two peaks, and noise with a gap."""
    rng = np.random.default_rng(2)
    count = 300_001
    time = 0.001 * np.arange(count)
    first = np.sin(time / 9.0) + (-1.0) ** np.arange(count)
    first[[77_777, 222_222]] = 40.0, -50.0
    second = rng.standard_normal(count)
    second[123_456] = np.nan
    return first, second


def test_peaks_gaps_and_ends_of_a_long_curve_stay(long):
    found = taken(long, 8192).result()
    assert not found.whole
    assert len(found.time) <= CAPACITY + 2
    assert np.all(np.diff(found.time) > 0)
    assert {0.0, 77.777, 222.222, 123.456, 300.0} <= set(np.round(found.time, 9).tolist())
    for kept, signal in zip(found.signals, long, strict=True):
        assert (np.nanmin(kept), np.nanmax(kept)) == (np.nanmin(signal), np.nanmax(signal))
        at = np.round(1000 * found.time).astype(int)
        assert np.array_equal(kept, signal[at], equal_nan=True)


def test_what_is_kept_does_not_depend_on_the_pieces(long):
    whole = taken(long, 10**6).result()
    for size in (5_000, 8192, 100_000):
        found = taken(long, size).result()
        for one, other in zip(
            (found.time, *found.signals, found.typical),
            (whole.time, *whole.signals, whole.typical),
            strict=True,
        ):
            assert np.array_equal(one, other, equal_nan=True)


def test_memory_stays_constant(long):
    thinner = taken(long, 4000)
    assert thinner._held <= 2 * CAPACITY + 4000


def test_typical_points_have_the_percentiles_of_all(long):
    found = taken(long, 8192).result()
    for kept, signal in zip(found.signals, long, strict=True):
        known = kept[found.typical]
        expected = np.nanpercentile(signal, (2.0, 25.0, 50.0, 75.0, 98.0))
        assert np.nanpercentile(known, (2, 25, 50, 75, 98)) == pytest.approx(expected, abs=0.12)


def test_short_curves_and_the_window_are_whole(long):
    short = tuple(signal[:CAPACITY] for signal in long)
    found = taken(short, 999).result()
    assert found.whole
    assert found.typical.all()
    assert np.array_equal(found.signals[0], short[0])
    near = taken(long, 5000, Window(10.0, 14.0)).near()
    assert near.time == pytest.approx(np.arange(10.0, 14.0005, 0.001))
    assert np.array_equal(near.signals[0], long[0][10_000:14_001])
    assert len(Thinner(1).result().time) == 0
