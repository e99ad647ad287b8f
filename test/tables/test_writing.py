"""What is written is read again as it was."""

from pathlib import Path

import numpy as np
import pytest

from fpt_ros.errors import BadInput
from fpt_ros.tables.reading import read
from fpt_ros.tables.table import Column, Kind
from fpt_ros.tables.writing import check_target, encoded

COLUMNS = (
    Column("stamp", Kind.TIME, np.array(["2024-03-01T12:00:00.5", "NaT"] * 15000, "M8[ns]"), "UTC"),
    Column("y", Kind.NUMBER, np.array([0.1 + 0.2, np.nan] * 15000), "m/s"),
    Column("count", Kind.NUMBER, np.array([2**53 + 1, -7] * 15000)),
    Column("on", Kind.BOOL, np.array([1.0, np.nan] * 15000)),
    Column("state", Kind.TEXT, np.array(['a "b", c', ""] * 15000, dtype=object)),
)


@pytest.mark.parametrize("name", ["s.csv", "s.tsv", "s.csv.gz", "s.parquet"])
def test_written_and_read(tmp_path, name):
    (tmp_path / name).write_bytes(b"".join(encoded(COLUMNS, tmp_path / name)))
    found = read(tmp_path / name)
    assert [column.name for column in found.columns] == [column.name for column in COLUMNS]
    for new, old in zip(found.columns[:3], COLUMNS[:3], strict=True):
        np.testing.assert_array_equal(new.values, old.values)
    assert found.column("y").unit == "m/s"
    np.testing.assert_array_equal(found.column("on").numbers(), COLUMNS[3].values)
    assert found.column("state").values.tolist() == COLUMNS[4].values.tolist()


def test_arrays(tmp_path):
    (tmp_path / "s.npz").write_bytes(b"".join(encoded(COLUMNS[1:3], tmp_path / "s.npz")))
    found = read(tmp_path / "s.npz")
    np.testing.assert_array_equal(found.column("y").values, COLUMNS[1].values)
    assert found.column("count").values.tolist()[:2] == [2**53 + 1, -7]


@pytest.mark.parametrize("name", ["s.mat", "s", "s.xlsx", "s.gz"])
def test_names_that_say_no_kind_are_refused(name):
    with pytest.raises(BadInput, match=r"it takes a name that ends in \.csv"):
        check_target("--out", Path(name))
