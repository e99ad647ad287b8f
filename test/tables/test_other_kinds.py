"""JSON, arrays, Parquet, WAV and compressed files: the same numbers from all of them."""

import io
import json
import sys
from pathlib import Path

import numpy as np
import pyarrow
import pytest
import scipy.io
from pyarrow import parquet
from scipy.io import wavfile
from tables.kinds import N, T, Y
from tables.other_kinds import SAME, saved, zipped

from fpt_ros.errors import BadInput
from fpt_ros.tables.reading import read
from fpt_ros.tables.table import Kind


@pytest.mark.parametrize("name", SAME)
def test_the_same_numbers(tmp_path, name):
    path = tmp_path / name
    path.write_bytes(SAME[name])
    t, y = read(path).columns
    np.testing.assert_array_equal(t.numbers(), T)
    np.testing.assert_array_equal(y.numbers(), Y)


def test_standard_input(monkeypatch):
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(SAME["s.csv.gz"])))
    np.testing.assert_array_equal(read(Path("-")).column("y").numbers(), Y)


@pytest.mark.parametrize("shape", [(N,), (N, 1), (1, N)])
def test_one_signal_of_any_shape(tmp_path, shape):
    np.save(tmp_path / "s.npy", Y.reshape(shape))
    (column,) = read(tmp_path / "s.npy").columns
    np.testing.assert_array_equal(column.numbers(), Y)


def test_missing_values(tmp_path):
    (tmp_path / "s.jsonl").write_text('{"y": 1.5}\n{"x": 1}\n{"y": null}\n{"y": 2}\n{"y": "ERR"}\n')
    found = read(tmp_path / "s.jsonl")
    expected = [1.5, np.nan, np.nan, 2.0, np.nan]
    np.testing.assert_array_equal(found.column("y").numbers(), expected)
    assert found.remarks == ("y: line 5 is 'ERR': taken as missing",)
    parquet.write_table(pyarrow.table({"y": [1, None, 3]}), tmp_path / "s.parquet")
    y = read(tmp_path / "s.parquet").column("y").numbers()
    np.testing.assert_array_equal(y, [1.0, np.nan, 3.0])


def test_values_inside_of_others(tmp_path):
    rows = [{"stamp": {"sec": i}, "position": [i, 2 * i]} for i in range(5)]
    (tmp_path / "s.jsonl").write_text("\n".join(map(json.dumps, rows)))
    found = read(tmp_path / "s.jsonl")
    assert [c.name for c in found.columns] == ["stamp.sec", "position[0]", "position[1]"]
    assert found.column("position[1]").values.tolist() == [0, 2, 4, 6, 8]
    scipy.io.savemat(tmp_path / "s.mat", {"run": {"t": T, "y": Y}})
    assert [c.name for c in read(tmp_path / "s.mat").columns] == ["run.t", "run.y"]


def test_times_in_parquet(tmp_path):
    stamps = pyarrow.array([0, 10_000], pyarrow.timestamp("us", "UTC"))
    parquet.write_table(pyarrow.table({"stamp": stamps, "y": [1.0, 2.0]}), tmp_path / "s.parquet")
    column = read(tmp_path / "s.parquet").column("stamp")
    assert column.kind is Kind.TIME
    assert np.diff(column.values).astype(int).tolist() == [10_000_000]


def test_a_sound_keeps_the_numbers_of_its_file(tmp_path):
    values = (1000 * np.stack([Y, -Y], axis=1)).astype(np.int16)
    wavfile.write(tmp_path / "s.wav", 8000, values)
    time, left, right = read(tmp_path / "s.wav").columns
    assert time.unit == "s"
    np.testing.assert_allclose(time.values, np.arange(N) / 8000)
    np.testing.assert_array_equal(left.values, values[:, 0])
    np.testing.assert_array_equal(right.values, values[:, 1])


def test_arrays_of_several_lengths_need_a_name(tmp_path):
    np.savez(tmp_path / "s.npz", y=Y, z=Y[:50], t=T)
    with pytest.raises(BadInput, match=r"--column says which: y \(120\), z \(50\), t \(120\)"):
        read(tmp_path / "s.npz")
    assert [c.name for c in read(tmp_path / "s.npz", "y").columns] == ["y", "t"]
    assert len(read(tmp_path / "s.npz", "z")) == 50


@pytest.mark.parametrize(
    ("name", "content", "said"),
    [
        ("s.json", b'[{"y": 1}, {"y": 2', "line 1 is not JSON"),
        ("s.jsonl", b'{"y": 1}\n{"y": 2}\n{"y": 3', "line 3 is not JSON"),
        ("s.npy", SAME["fields.npy"][:200], "cannot be read as a NumPy array"),
        ("s.npz", SAME["s.npz"][:300], "damaged zip archive"),
        ("s.parquet", SAME["s.parquet"][:100], "cannot be read as a Parquet file"),
        ("s.mat", SAME["s.mat"][:150], "cannot be read as a MAT file"),
        ("s.wav", b"RIFF\x10\x00\x00\x00WAVEfmt ", "cannot be read as a WAV file"),
        ("s.parquet", b"t,y\n1,2\n", "is no PARQUET file, whatever its name says"),
        ("s.csv", b"SQLite format 3\0" + bytes(90), "give the recording's folder"),
        ("s.xlsx", zipped("xl/workbook.xml", "<x/>"), "save the sheet as CSV"),
        ("s.npy", saved(lambda file: np.save(file, np.zeros((2, 2, 2)))), "3 dimensions"),
        ("s.npy", saved(lambda file: np.save(file, np.empty(0))), "is empty"),
    ],
)
def test_what_cannot_be_read_is_refused_in_one_line(tmp_path, name, content, said):
    (tmp_path / name).write_bytes(content)
    with pytest.raises(BadInput) as caught:
        read(tmp_path / name)
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)


def test_complex_numbers_are_no_signal(tmp_path):
    np.savez(tmp_path / "s.npz", y=Y, z=1j * Y)
    with pytest.raises(BadInput, match="column 'z' holds complex numbers"):
        read(tmp_path / "s.npz").column("z").numbers()
