"""The column of times is found, used, and never ignored."""

import numpy as np
import pytest
from tables.kinds import ROWS, N, T, text

from fpt_ros.errors import BadInput
from fpt_ros.tables import times
from fpt_ros.tables.reading import read
from fpt_ros.tables.spacing import spacing_of
from fpt_ros.tables.table import Column, Kind, Table
from fpt_ros.tables.time_axis import find


def numbers(name, values, unit=""):
    return Column(name, Kind.NUMBER, np.asarray(values), unit)


def table_of(t, name="t", unit=""):
    y = numbers("y", np.arange(len(t), dtype=float))
    return Table((numbers(name, np.asarray(t, dtype=float), unit), y), "s.csv")


def spacing(t, **names):
    table = table_of(t, **names)
    return spacing_of(table, find(table, None))


@pytest.mark.parametrize(
    "name", ["t", "time", "Time", "stamp", "header.stamp", "timestamp", "time_ms", "%time", "Zeit"]
)
def test_names_of_times(name):
    assert find(table_of(T[::-1], name), None) is not None


@pytest.mark.parametrize("name", ["y2", "response_time", "T", "tension", "runtime", "position"])
def test_other_names_are_not(name):
    assert find(table_of(np.sin(T), name), None) is None


def test_a_unit_or_equal_steps_tell_too():
    assert find(table_of(np.cumsum(T), "x", "ms"), None).second == 1e-3
    assert find(table_of(T, "x"), None).column == "x"
    assert find(table_of(np.cumsum(T), "x"), None) is None  # a motion, say


def test_the_user_has_the_last_word():
    table = table_of(np.cumsum(T), "x")
    assert find(table, "x").column == "x"
    assert find(table_of(T), "none") is None
    assert find(table_of(T), None, signals=("t",)) is None
    with pytest.raises(BadInput, match="no column 'z'"):
        find(table, "z")


@pytest.mark.parametrize(
    ("first", "step"), [(1.7e9, 0.01), (1.7e12, 10), (1.7e15, 10_000), (17 * 10**17, 10_000_000)]
)
def test_stamps_since_1970_become_seconds(first, step):
    table = Table((numbers("stamp", first + step * np.arange(5)), numbers("y", np.arange(5))), "s")
    axis = find(table, None)
    assert axis.unit == "s"
    np.testing.assert_allclose(axis.values, 0.01 * np.arange(5), atol=1e-6)


@pytest.mark.parametrize(
    ("head", "row"),
    [
        (("time", "y"), "2024-03-01T23:59:{:05.2f}Z,0"),
        (("time", "y"), "2024-03-01 23:59:{:05.2f},0"),
        (("time", "y"), "2024/03/01 23:59:{:05.2f},0"),
        (("time", "y"), "2024-03-01T23:59:{:05.2f}+02:00,0"),
        (("time", "y"), "01.03.2024 23:59:{:05.2f},0"),
        (("date", "time", "y"), "2024-03-01,23:59:{:05.2f},0"),
        (("time", "y"), "23:59:{:05.2f},0"),
    ],
)
def test_dates_and_times_of_day(tmp_path, head, row):
    (tmp_path / "s.csv").write_text(
        "\n".join([",".join(head), *(row.format(10 + t) for t in T[:100])])
    )
    axis = find(read(tmp_path / "s.csv"), None)
    assert axis.unit == "s"
    np.testing.assert_allclose(axis.values, T[:100], atol=1e-9)


def test_midnight_is_passed(tmp_path):
    words = ["23:59:59.5", "23:59:59.75", "00:00:00.0", "00:00:00.25"]
    (tmp_path / "s.csv").write_text("time;y\n" + "".join(f"{word};1,5\n" for word in words))
    axis = find(read(tmp_path / "s.csv"), None)
    np.testing.assert_allclose(axis.values, [0.0, 0.25, 0.5, 0.75])


def test_times_are_written_as_they_were():
    words = ["2024-03-01T12:00:10.250Z", "", "1969-12-31T23:59:59.000Z"]
    values, zone = times.times(words)
    assert zone
    assert times.text(values, "UTC") == words


def test_a_missing_time_is_refused_with_its_line(tmp_path):
    rows = list(ROWS)
    rows[7] = ("", rows[7][1])
    (tmp_path / "s.csv").write_text(text(rows=rows))
    with pytest.raises(BadInput, match="the time 't' is missing in line 9"):
        find(read(tmp_path / "s.csv"), None)


# --- spacing


def test_equal_spacing_is_seen_through_rounding():
    found = spacing(np.round(np.arange(1000) / 300, 3))
    assert found.times is not None or found.jitter < 0.2
    assert found.count == 1000
    assert found.step == pytest.approx(1 / 300, rel=1e-5)
    assert spacing(T).times is None
    assert spacing(T).remarks == ()
    assert spacing(1.7e9 + T).times is None


def test_rows_in_any_order_go_to_their_places():
    order = np.random.default_rng(1).permutation(N)
    found = spacing(T[order])
    assert "not in the order of 't'" in found.remarks[0]
    y = np.sin(T)
    np.testing.assert_array_equal(found.samples(y[order]), y)
    np.testing.assert_array_equal(found.rows(y), y[order])


def test_missing_rows_are_holes():
    kept = np.delete(np.arange(N), [5, 6, 7, 50])
    found = spacing(T[kept])
    assert found.times is None
    assert "4 samples are missing between the rows" in found.remarks[0]
    samples = found.samples(np.sin(T[kept]))
    assert np.flatnonzero(np.isnan(samples)).tolist() == [5, 6, 7, 50]
    np.testing.assert_array_equal(found.rows(samples), np.sin(T[kept]))


def test_rows_of_one_time_are_one_sample():
    t = np.insert(T, 10, T[10])
    found = spacing(t)
    assert found.count == N
    assert found.remarks == ("1 rows have the time of another: the mean counts",)
    y = np.zeros(N + 1)
    y[10:12] = 1.0, 3.0
    assert found.samples(y)[10] == 2.0
    y[10] = np.nan
    assert found.samples(y)[10] == 3.0


def test_a_coarse_clock_loses_no_sample():
    found = spacing(np.repeat(T[::2], 2)[:N])
    assert found.count == N
    assert found.step == pytest.approx(0.01)
    assert "coarse clock" in found.remarks[0]


def test_unequal_times_are_given_on():
    t = np.sort(np.random.default_rng(0).uniform(0, 1, N))
    found = spacing(t)
    assert not found.even
    np.testing.assert_array_equal(found.times, t)
    assert "unequally spaced" in found.remarks[0]
    pause = spacing(np.r_[T, T + 1e6])
    assert not pause.even


def test_jitter_is_told_and_its_times_are_given_on():
    t = T + 0.003 * np.sin(np.arange(N) ** 2)
    found = spacing(t)
    assert found.even
    np.testing.assert_allclose(found.times, t)
    assert "jitter" in found.remarks[0]


def test_two_records_in_one_file_are_not_mixed():
    with pytest.raises(BadInput, match="begin anew in row 121: are these several records"):
        spacing(np.r_[T, T])
    assert spacing(np.r_[T[60:], T[:60]]).count == N  # a ring buffer


def test_times_that_do_not_go_on():
    with pytest.raises(BadInput, match="are all 1: give others, or --time none"):
        spacing(np.ones(N))


@pytest.mark.parametrize("scale", [1e-9, 1.0, 1e9])
def test_the_unit_of_the_times_changes_nothing(scale):
    kept = np.delete(np.arange(N), [5, 50])
    found, scaled = spacing(T[kept]), spacing(scale * T[kept])
    assert scaled.count == found.count
    np.testing.assert_array_equal(scaled.index, found.index)
