"""The tables of a sweep: what stands in the journal, with its types."""

import numpy as np
import pandas
import pytest

from fpt_ros.sweep.definition import define
from fpt_ros.sweep.journal import Journal
from fpt_ros.sweep.results import read
from fpt_ros.sweep.table import write_tables

GRIDS = [
    "fpt_deformer.A=-1,-2.5",
    "plant_simulator.substeps=1:2:2",
    "fpt_deformer.transformation=sgfpt,none",
    "parameter_tuner.precursor=false,true",
    "plant_simulator.limit.position=[1.0,2.0,2.0],[3.0,4.0,4.0]",
]
REASON = 'diverged, "far" beyond\nits limit'


@pytest.fixture
def tables(tmp_path):
    """Journal, CSV and Parquet of a sweep whose rows are made up; the last run is not there."""
    sweep = define("tora", "adaptive", (), 1.0, GRIDS, None, 0, ("rms.q3", "chatter"))
    count = len(sweep.job.columns)
    rows = []
    for number in reversed(range(sweep.size - 1)):
        point = [list(v) if isinstance(v, tuple) else v for v in sweep.job.space.point(number)]
        value = None if number == 3 else (number + 0.1) / 3.0
        ending = ["diverged", 0.25, REASON, 250] if number == 3 else ["complete", None, "", 1000]
        rows.append([number, *point, *ending, value, 1e-300])
    with Journal(tmp_path / "journal", sweep.size, count, 1 + len(GRIDS)) as journal:
        journal.append(rows)
        return rows[::-1], *write_tables(sweep, journal, tmp_path)


def test_both_hold_every_row_by_its_number(tables):
    rows, text, binary = tables
    found = pandas.read_parquet(binary)
    kinds = [str(found[name].dtype) for name in found.columns]
    assert kinds[:3] == ["int64", "float64", "int64"]
    assert kinds[4] == "bool"
    assert found["run"].tolist() == list(range(len(rows)))
    same = pandas.read_csv(text, keep_default_na=False, na_values={"rms.q3": "", "diverged_at": ""})
    pandas.testing.assert_frame_equal(found, same, check_dtype=False, check_exact=True)
    assert found["reason"][3] == REASON
    assert found["plant_simulator.limit.position"][0] == "[1.0, 2.0, 2.0]"


def test_numbers_are_those_of_the_journal_to_the_bit(tables):
    rows, _, binary = tables
    found = read(binary, ["run", "rms.q3", "chatter", "reason", "parameter_tuner.precursor"])
    expected = np.array([row[-2] for row in rows], dtype=np.float64)
    np.testing.assert_array_equal(found["rms.q3"], expected)
    assert set(found["chatter"]) == {1e-300}
    assert found["run"].dtype == np.int64
    assert found["parameter_tuner.precursor"].dtype == np.bool_
    assert found["reason"].tolist() == [row[-4] for row in rows]
