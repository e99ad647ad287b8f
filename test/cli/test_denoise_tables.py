"""``fpt denoise`` on tables as people have them: which signal, which times, what is told."""

import csv
import io
import json
import os
import subprocess
import sys

import numpy as np
import pytest
from command import BIN, TIMEOUT
from tables.kinds import LOST, NAMELESS, PLAIN, ROWS, WHOLE, N, T, Y, text, with_line
from tables.other_kinds import SAME, SOUND, sound

from fpt_ros.cli.app import run_command
from fpt_ros.denoising.offline import denoise

SAVGOL = ("--method", "savgol")


@pytest.fixture
def run(tmp_path, monkeypatch, capsys):
    """Run ``fpt denoise`` in this process on a file of this content."""
    monkeypatch.chdir(tmp_path)

    def denoise(content, *arguments, name="s.csv", expected=0):
        (tmp_path / name).write_bytes(content if isinstance(content, bytes) else content.encode())
        status = run_command(["denoise", name, *SAVGOL, *map(str, arguments)])
        said = capsys.readouterr()
        assert status == expected, said.err
        return said

    return denoise


def output(path):
    """The columns of a CSV that was written, by their headings."""
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    return dict(zip(rows[0], zip(*rows[1:], strict=True), strict=True))


@pytest.fixture
def plain(run):
    """The estimate of the plain record."""
    run(PLAIN, "--out", "plain.csv")
    return output("plain.csv")["estimate"]


@pytest.mark.parametrize("kind", [*WHOLE, *NAMELESS])
def test_the_same_estimate_of_all_kinds(run, plain, kind):
    found = json.loads(run({**WHOLE, **NAMELESS}[kind], "--json").out)
    assert (found["samples"], found["healed"]) == (N, 0)
    assert output("s-denoised.csv")["estimate"] == plain


@pytest.mark.parametrize("name", SAME)
def test_the_same_estimate_of_other_files(run, plain, name):
    column = "f1" if name == "fields.npy" else "y"  # a dtype without names
    found = json.loads(
        run(SAME[name], "--column", column, "--out", "o.csv", "--json", name=name).out
    )
    assert (found["samples"], found["healed"]) == (N, 0)
    estimate = np.array(output("o.csv")["estimate"], dtype=float)
    np.testing.assert_allclose(estimate, np.array(plain, dtype=float), rtol=1e-12)


def test_a_sound(run):
    found = json.loads(run(sound(), "--out", "o.csv", "--json", name="s.wav").out)
    assert (found["samples"], found["healed"]) == (N, 0)
    y = np.array(output("o.csv")["estimate"], dtype=float)
    np.testing.assert_allclose(y, denoise(SOUND, "savgol").estimate, rtol=1e-9)


@pytest.mark.parametrize("kind", LOST)
def test_the_signal_is_healed_where_a_cell_is_no_number(run, kind):
    line, said = LOST[kind]
    found = json.loads(run(with_line(62, line), "--json").out)
    assert (found["signal"], found["healed"]) == ("y", 1)
    assert any(said in remark for remark in found["remarks"]) if said else not found["remarks"]
    assert [at for at, x in enumerate(output("s-denoised.csv")["healed"]) if x == "1"] == [60]


def test_the_times_are_never_the_signal(run):
    garbled = text(rows=[(t, f"{y} V") for t, y in ROWS])
    said = run(garbled, expected=2).err
    assert "no column of numbers but the times 't': column 'y' is not numbers: line 2" in said
    assert not os.path.exists("s-denoised.csv")
    alone = text(head=("t",), rows=[row[:1] for row in ROWS])
    assert "--column t takes them as the signal" in run(alone, expected=2).err
    assert "t: 120 samples" in run(alone, "--column", "t").out


def test_names_units_and_times_stay(run):
    rows = [(f"2024-03-01T12:00:{10 + t:05.2f}Z", y, y) for t, (_, y) in zip(T, ROWS, strict=True)]
    said = run(text(head=("when", "U [mV]", "I [A]"), rows=rows), "--column", "U")
    assert "times: when, 0 to 1.19 s, step 0.01 s, 100 Hz" in said.out
    assert " mV" in said.out
    table = output("s-denoised.csv")
    assert list(table) == ["when", "U [mV]", "I [A]", "healed", "estimate [mV]"]
    assert table["when"][1] == "2024-03-01T12:00:10.010Z"


def test_all_columns_but_the_times(run, plain):
    rows = [(t, y, "ok", y, "", "True") for t, y in ROWS]
    table = text(head=("t", "a", "state", "b", "empty", "on"), rows=rows)
    found = json.loads(run(table, "--column", "all", "--json").out)
    assert [signal["signal"] for signal in found["signals"]] == ["a", "b"]
    table = output("s-denoised.csv")
    assert table["a estimate"] == table["b estimate"] == plain


def test_rows_in_any_order_have_their_own_estimates(run, plain):
    order = np.random.default_rng(0).permutation(N)
    said = run(text(rows=[ROWS[at] for at in order]))
    assert "not in the order of 't'" in said.err
    assert output("s-denoised.csv")["estimate"] == tuple(plain[at] for at in order)


def test_rows_that_are_missing_are_bridged(run):
    kept = [at for at in range(N) if at not in (40, 41, 42)]
    found = json.loads(run(text(rows=[ROWS[at] for at in kept]), "--json").out)
    assert "3 samples are missing between the rows, by 't'" in found["remarks"]
    estimate = np.array(output("s-denoised.csv")["estimate"], dtype=float)
    run(text(rows=[ROWS[a] if a in kept else (ROWS[a][0], "") for a in range(N)]))
    healed = np.array(output("s-denoised.csv")["estimate"], dtype=float)
    np.testing.assert_array_equal(estimate, healed[kept])


def test_unequal_times_are_used_or_refused_with_a_remedy(run):
    t = np.sort(np.random.default_rng(0).uniform(0, 1, N))
    unequal = text(rows=[(f"{a:.5f}", y) for a, (_, y) in zip(t, ROWS, strict=True)])
    said = run(unequal, expected=2).err
    assert len(said.splitlines()) == 1
    assert "unequally spaced" in said
    assert "--time none takes the rows as equally spaced" in said
    run(unequal, "--time", "none")


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--column", "z"], "columns of numbers are t, y"),
        (["--time", "z"], "no column 'z'"),
        (["--topic", "/x", "--field", "y"], "are for recordings"),
        (["--out", "s.csv"], "is the input"),
        (["--out", "x.mat"], "it takes a name that ends in .csv"),
        (["--out", "no/x.csv"], "the folder no does not exist"),
        (["--out", "-", "--json"], "cannot both go to standard output"),
    ],
)
def test_bad_options(run, arguments, said):
    line = run(PLAIN, *arguments, expected=2).err
    assert said in line
    assert len(line.splitlines()) == 1
    assert os.listdir() == ["s.csv"]


def test_a_file_of_a_recording_is_told_what_it_takes(run):
    line = run(b"SQLite format 3\0", name="bag_0.db3", expected=2).err
    assert "bag_0.db3 is a recording: --topic and --field say which signal" in line
    assert len(line.splitlines()) == 1


@pytest.mark.parametrize("kind", ["png", "svg", "pdf"])
def test_pictures(run, kind):
    run(PLAIN, "--plot", f"s.{kind}")
    start = {"png": b"\x89PNG", "svg": b"<?xml", "pdf": b"%PDF"}[kind]
    with open(f"s.{kind}", "rb") as file:
        assert file.read().startswith(start)


@pytest.mark.parametrize(
    "y", [np.zeros(N), np.arange(N) * 1e300, np.where(np.arange(N) % 7, Y, np.nan), 1e-300 * Y]
)
def test_pictures_of_odd_records(run, y):
    rows = [(t, "" if np.isnan(x) else repr(float(x))) for (t, _), x in zip(ROWS, y, strict=True)]
    run(text(rows=rows), "--plot", "s.png")
    assert os.path.getsize("s.png") > 1000


def test_a_pipe(tmp_path):
    done = subprocess.run(
        [BIN / "fpt", "denoise", "-", *SAVGOL],
        input=text(";", ",").encode(),
        capture_output=True,
        timeout=TIMEOUT,
        cwd=tmp_path,
        check=True,
    )
    table = list(csv.DictReader(io.StringIO(done.stdout.decode())))
    assert [float(row["y"]) for row in table] == Y.tolist()
    assert b"standard input: separated by ';', decimal commas" in done.stderr
    assert not list(tmp_path.iterdir())


def test_a_home_that_cannot_be_written_is_no_matter(tmp_path):
    (tmp_path / "s.csv").write_text(PLAIN)
    done = subprocess.run(
        [BIN / "fpt", "denoise", "s.csv", *SAVGOL],
        capture_output=True,
        text=True,
        timeout=TIMEOUT,
        cwd=tmp_path,
        env={**os.environ, "HOME": "/dev/null", "MPLCONFIGDIR": ""},
        check=True,
    )
    assert done.stderr == ""


def test_a_long_record_is_read_in_chunks(tmp_path):
    """Reading keeps 8 bytes a number, not its text: 300,000 rows of 100 characters."""
    path = tmp_path / "s.csv"
    with path.open("w") as file:
        file.write("t,a,b,c\n")
        file.writelines(f"{i},{i:030d},{i:030d},{i:030d}\n" for i in range(300_000))
    program = (
        "import resource, sys; from pathlib import Path; from fpt_ros.tables.reading import read;"
        "use = lambda: resource.getrusage(resource.RUSAGE_SELF).ru_maxrss;"
        "before = use(); table = read(Path(sys.argv[1])); print(len(table), use() - before)"
    )
    done = subprocess.run(
        [sys.executable, "-c", program, path], capture_output=True, text=True, check=True
    )
    rows, grown = map(int, done.stdout.split())
    assert rows == 300_000
    assert grown < 70_000  # KiB; the text has 30 MB, its cells as Python's strings 100 MB
