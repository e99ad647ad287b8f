"""Recordings as tables, as files of other programs, and against each other."""

import io
import subprocess
import sys
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from damaged import INFO, PARAMETERS, fill, recording
from scipy.io import loadmat
from test_one_field import Row, joints

import fpt_ros
from fpt_ros.bags.difference import compare
from fpt_ros.bags.export import FORMATS, target
from fpt_ros.bags.tables import read_tables
from fpt_ros.bags.writer import BagWriter
from fpt_ros.errors import BadInput


@pytest.fixture(scope="module")
def bag(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return recording(tmp_path_factory.mktemp("tables") / "bag", 40).parent


def test_load(bag: Path) -> None:
    tables = fpt_ros.load(bag)
    assert list(tables) == ["/command", "/joint_states"]
    states, command = tables["/joint_states"], tables["/command"]
    assert states.index.name == "time"
    assert states.index.tolist() == [k / 1000 for k in range(40)]
    assert states["position.q1"].tolist() == [float(k) for k in range(40)]
    assert states["velocity.q2"].tolist() == [0.5] * 40
    assert command["accelerations.q1"].tolist() == [float(k) for k in range(40)]
    assert command["effort.q1"].tolist() == [3.0 * k for k in range(40)]
    units = states.attrs["units"]
    assert set(units) == {"time", *states.columns}
    # of TORA: q1 is an angle [rad], its force a torque
    assert (units["position.q1"], units["velocity.q1"], units["effort.q1"]) == (
        "rad",
        "rad/s",
        "N m",
    )
    assert states.attrs["missing"] == []


def test_load_of_other_robots(tmp_path: Path) -> None:
    rows: list[Row] = [(10**9, ("a", "b"), (1, 2), ()), (2 * 10**9, ("b",), (3,), ())]
    (table,) = fpt_ros.load(joints(tmp_path / "a.mcap", rows)).values()
    assert table.index.tolist() == [1.0, 2.0]
    assert np.array_equal(table["position.a"], [1.0, np.nan], equal_nan=True)
    assert table["position.b"].tolist() == [2.0, 3.0]


def test_importing_the_package_takes_no_pandas() -> None:
    code = "import fpt_ros, sys; sys.exit('pandas' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_formats_hold_the_same_numbers(bag: Path, tmp_path: Path) -> None:
    tables = read_tables(bag)
    path = tmp_path / "file"
    written = {name: write(tables) for name, write in FORMATS.items()}
    csv = pd.read_csv(io.BytesIO(written["csv"]), index_col=0)
    parquet = pd.read_parquet(io.BytesIO(written["parquet"]))
    npz = np.load(io.BytesIO(written["npz"]), allow_pickle=False)
    path.write_bytes(written["mat"])
    mat = loadmat(path, simplify_cells=True)
    expected = [3.0 * k for k in range(40)]
    assert csv["command.effort.q1 [N m]"].tolist() == expected
    assert parquet["command.effort.q1 [N m]"].tolist() == expected
    assert npz["command.effort.q1"].tolist() == expected
    assert dict(npz["units"])["command.effort.q1"] == "N m"
    assert mat["command"]["effort_q1"].tolist() == expected
    assert mat["command"]["units"]["effort_q1"] == "N m"
    for table in (csv, parquet):
        assert table.index.name == "time [s]"
        assert table.index.tolist() == [k / 1000 for k in range(40)]


def test_one_time_axis_of_topics_with_other_times(tmp_path: Path) -> None:
    with BagWriter(tmp_path / "bag", PARAMETERS, INFO) as writer:
        fill(writer, 3)
        data = b"\x00\x01\x00\x00" + np.float64(7).tobytes()
        for stamp in (500_000, 500_000, 2_000_000):
            writer.write("/value", "std_msgs/msg/Float64", stamp, data)
    table = pd.read_csv(io.BytesIO(FORMATS["csv"](read_tables(tmp_path / "bag"))), index_col=0)
    assert table.index.tolist() == [0.0, 0.0005, 0.0005, 0.001, 0.002]
    value = table["value.data"]
    assert np.array_equal(value, [np.nan, 7.0, 7.0, np.nan, 7.0], equal_nan=True)
    assert np.isnan(table["command.effort.q1 [N m]"].iloc[1])


def test_where_an_export_goes(bag: Path) -> None:
    assert target(bag, "mat", None) == bag.with_name("bag.mat")
    with pytest.raises(BadInput, match="formats are csv, parquet, mat, npz"):
        target(bag, "xlsx", None)
    with pytest.raises(BadInput, match="is the recording or a folder"):
        target(bag, "csv", bag)


def test_recordings_that_are_equal(bag: Path, tmp_path: Path) -> None:
    other = recording(tmp_path / "other", 40, chunks=1).parent
    found = compare(read_tables(bag), read_tables(other))
    assert found.equal
    assert found.first is None


def test_the_first_difference_and_how_much(bag: Path, tmp_path: Path) -> None:
    other = recording(tmp_path / "other", 40, first=0).parent
    one, two = read_tables(bag), read_tables(other)
    changed = two.tables["/command"].copy()
    column = changed.columns.get_loc("effort.q1")
    changed.iloc[7, column] += 4.0
    changed.iloc[9, column] -= 3.0
    two.tables["/command"] = changed  # type: ignore[index]
    found = compare(one, two)
    assert found.first is not None
    assert (found.first.topic, found.first.name) == ("/command", "effort.q1")
    assert (found.first.row, found.first.time, found.first.values) == (7, 0.007, (21.0, 25.0))
    (field,) = found.fields
    assert (field.count, field.largest, field.unit) == (2, 4.0, "N m")
    assert field.rms == pytest.approx((25.0 / 40) ** 0.5)


def test_another_length_and_another_topic(bag: Path, tmp_path: Path) -> None:
    other = recording(tmp_path / "other", 30, chunks=1).parent
    two = read_tables(other)
    del two.tables["/command"]  # type: ignore[attr-defined]
    found = compare(read_tables(bag), two)
    assert found.counts == {"/joint_states": (40, 30)}
    assert found.only == {"/command": 1}
    assert not found.equal
    assert found.fields == []
