"""Text tables: read right, or refused in one line that names the line of the file."""

import gzip
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tables.kinds import LOST, NAMELESS, PLAIN, ROWS, WHOLE, N, T, Y, text, with_inserted, with_line

from fpt_ros.errors import BadInput
from fpt_ros.tables.reading import read
from fpt_ros.tables.table import Kind


@pytest.fixture
def table(tmp_path):
    def make(content, name="s.csv", encoding="utf-8"):
        path = tmp_path / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode(encoding))
        return read(path)

    return make


def refusal(table, content):
    """The one line that a text is refused with."""
    with pytest.raises(BadInput) as caught:
        [column.numbers() for column in table(content).columns]
    line = str(caught.value)
    assert "\n" not in line
    return line


def check(found, names=("t", "y")):
    assert [column.name for column in found.columns] == list(names)
    np.testing.assert_array_equal(found.columns[0].numbers(), T)
    np.testing.assert_array_equal(found.columns[1].numbers(), Y)


@pytest.mark.parametrize("kind", WHOLE)
def test_the_same_numbers_in_all_kinds(table, kind):
    check(table(WHOLE[kind]))


@pytest.mark.parametrize("kind", NAMELESS)
def test_without_a_header_no_sample_is_lost(table, kind):
    check(table(NAMELESS[kind]), ("0", "1"))


@pytest.mark.parametrize("code", ["utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "utf-32"])
def test_encodings(table, code):
    check(table(PLAIN, encoding=code))


def test_latin_1_in_the_header(table):
    found = table(text(head=("t", "y [°C]")), encoding="latin-1")
    check(found)
    assert found.columns[1].unit == "°C"


@pytest.mark.parametrize("kind", LOST)
def test_one_cell_that_is_no_number_is_one_missing_sample(table, kind):
    line, said = LOST[kind]
    found = table(with_line(62, line))
    np.testing.assert_array_equal(found.column("t").numbers(), T)
    y = found.column("y").numbers()
    assert np.flatnonzero(np.isnan(y)).tolist() == [60]
    np.testing.assert_array_equal(np.delete(y, 60), np.delete(Y, 60))
    assert any(said in remark for remark in found.remarks) if said else not found.remarks


@pytest.mark.parametrize("cell", ["1.2.3", "0,5", "12 V", "1_000", "0x1F", "1 000.5"])
def test_a_garbled_number_is_refused_with_its_line(table, cell):
    line = with_line(62, f"0.60;{cell}", text(";"))
    assert "line 62: y is '" + cell in refusal(table, line)


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (with_line(62, "0.60"), "line 62 has 1 cell, all others have 2"),
        (with_line(62, "0.60,1,2"), "line 62 has 3 cells, all others have 2"),
        (text(head=("t", "y", "z")), "header in line 1 names 3 columns, line 2 has 2 cells"),
        (text(",", ","), "are its decimal marks commas?"),
        (with_line(62, '0.60,"0.1'), "line"),
        (with_line(62, "\0" * 9), "line 62 has 1 cell, of NUL bytes"),
        ("name,colour\na,red\nb,blue\n", "no column of numbers"),
        ("\n\n", "empty"),
        (b"\x7fELF\x01\x02\x03\x04" * 99, "of a kind that cannot be read"),
    ],
)
def test_what_cannot_be_read_is_refused(table, content, said):
    assert said in refusal(table, content)


def test_a_last_line_that_is_cut_is_left_out_and_told(table):
    found = table(PLAIN + "1.2")
    check(found)
    assert found.remarks == ("the last line, 122, is cut: left out",)


def test_what_is_passed_over_is_told(table):
    assert table(WHOLE["header repeated"]).remarks == ("header repeated in line 63: passed over",)
    assert table("Model,XYZ\n\n" + PLAIN).remarks == ("line 1 above the table passed over",)
    assert table(with_inserted(9, "")).remarks == ("line 9 is empty: passed over",)


def test_empty_lines_are_missing_samples_of_a_single_column(table):
    cells = [y for _, y in ROWS]
    cells[21] = cells[22] = ""
    y = table("\n".join(["y", *cells]) + "\n\n").column("y").numbers()
    assert len(y) == N
    assert np.flatnonzero(np.isnan(y)).tolist() == [21, 22]


def test_units(table):
    below = table(with_inserted(2, "s,V"))
    check(below)
    assert [column.unit for column in below.columns] == ["s", "V"]
    assert [column.title for column in below.columns] == ["t [s]", "y [V]"]
    beside = table(text(" ", head=("t [s]", "y (m/s^2)")))
    check(beside)
    assert [column.title for column in beside.columns] == ["t [s]", "y (m/s^2)"]
    assert beside.columns[1].unit == "m/s^2"


def test_a_logger_with_names_units_and_processing(table):
    head = '"TOA5","CR1000","x"\n"t","y"\n"s","V"\n"Smp","Avg"\n'
    found = table(head + text(head=()))
    check(found)
    assert [column.unit for column in found.columns] == ["s", "V"]


def test_an_index_in_square_brackets_is_no_unit(table):
    found = table(text(head=("t", "position[2]")))
    assert (found.columns[1].name, found.columns[1].unit) == ("position[2]", "")


def test_times_as_dates_in_the_first_row_are_no_header(table):
    dates = [(f"2024-03-01T12:00:{10 + t:05.2f}Z", y) for t, (_, y) in zip(T, ROWS, strict=True)]
    time, y = table(text(head=(), rows=dates)).columns
    assert time.kind is Kind.TIME
    np.testing.assert_array_equal(y.numbers(), Y)
    since = (time.values - np.datetime64("2024-03-01T12:00:10")) / np.timedelta64(1, "ns")
    np.testing.assert_array_equal(since, np.round(T * 1e9))


def test_a_bad_cell_in_the_first_row_is_no_header(table):
    y = table(text(head=(), rows=[("0.00", "ERR"), *ROWS[1:]])).columns[1].numbers()
    assert len(y) == N
    assert math.isnan(y[0])


def test_true_and_false_are_numbers(table):
    rows = [(t, "True" if float(y) > 0 else "False") for t, y in ROWS]
    rows[50] = (rows[50][0], "")
    column = table(text(rows=rows)).column("y")
    assert column.kind is Kind.BOOL
    assert np.flatnonzero(np.isnan(column.numbers())).tolist() == [50]
    known = np.arange(N) != 50
    np.testing.assert_array_equal(column.numbers()[known], (Y > 0)[known])


def test_words_stay_words(table):
    words = [(*row, '"on, or off?"') for row in ROWS]
    found = table(text(head=("t", "y", "state"), rows=words))
    assert found.column("state").values.tolist() == ["on, or off?"] * N
    with pytest.raises(BadInput, match="column 'state' is not numbers: line 2 is 'on, or off"):
        found.column("state").numbers()


def test_a_column_without_any_cell_stays(table):
    found = table(text(head=("t", "y", "note"), tail=","))
    assert [column.name for column in found.columns] == ["t", "y", "note"]
    assert np.isnan(found.column("note").numbers()).all()


def test_stamps_in_nanoseconds_lose_no_digit(table):
    stamps = [1_710_000_000_000_000_001 + i * 10_000_000 for i in range(N)]
    rows = [(str(stamp), y) for stamp, (_, y) in zip(stamps, ROWS, strict=True)]
    assert table(text(rows=rows)).column("t").values.tolist() == stamps


def test_decimal_commas_that_come_late(table):
    rows = [("0", str(i)) for i in range(3000)] + [("1", "0,5")]
    y = table(text(";", rows=rows)).column("y").numbers()
    assert (y[2999], y[3000]) == (2999.0, 0.5)


def test_columns_of_one_name_are_told_apart(table):
    assert [c.name for c in table(text(head=("y", "y"))).columns] == ["y", "y.1"]


def test_columns_that_are_counted_have_a_header(table):
    rows = [(str(i), y, y) for i, (_, y) in enumerate(ROWS)]
    found = table(text(head=("", "0", "1"), rows=rows))
    assert len(found) == N
    assert [column.name for column in found.columns] == ["", "0", "1"]
    whole = table("1,2,3\n" + "".join(f"{i},{i % 3},{i % 5}\n" for i in range(50)))
    assert len(whole) == 51


def test_compressed(table, tmp_path):
    check(table(gzip.compress(PLAIN.encode()), "s.csv.gz"))
    assert "cut or damaged" in refusal(
        lambda content: table(content, "s.csv.gz"), gzip.compress(PLAIN.encode())[:200]
    )


numbers = st.floats(-1e6, 1e6, allow_nan=False).map(lambda x: round(x, 4))


@settings(max_examples=60, deadline=None)
@given(
    rows=st.lists(st.tuples(numbers, numbers, numbers), min_size=3, max_size=40),
    style=st.sampled_from(
        [(",", "."), (";", "."), (";", ","), ("\t", "."), ("\t", ","), (" ", ".")]
    ),
    header=st.booleans(),
    end=st.sampled_from(["\n", "\r\n"]),
    code=st.sampled_from(["utf-8", "utf-16", "utf-8-sig"]),
)
def test_what_is_written_is_read(tmp_path_factory, rows, style, header, end, code):
    separator, decimal = style
    cells = [tuple(f"{x:.4f}" for x in row) for row in rows]
    content = text(separator, decimal, ("t", "a", "b") if header else (), rows=cells, end=end)
    path = tmp_path_factory.mktemp("written") / "s.csv"
    path.write_bytes(content.encode(code))
    found = read(path)
    assert len(found.columns) == 3
    for at, column in enumerate(found.columns):
        np.testing.assert_array_equal(column.numbers(), [float(row[at]) for row in cells])


@settings(max_examples=60, deadline=None)
@given(
    kind=st.sampled_from(["plain", "semicolons and decimal commas", "blanks", "quoted", "tabs"]),
    at=st.integers(20, 100),
    place=st.integers(0, 12),
    new=st.sampled_from(["", *",;\"\t \n#%\0-+.eE07x|'_", "\n\n", "NaN", '",'])
    | st.characters(codec="utf-8"),
    instead=st.booleans(),
)
def test_one_wrong_character_spoils_one_row_or_is_refused(
    tmp_path_factory, kind, at, place, new, instead
):
    """No other row changes, and none is lost without a word."""
    lines = WHOLE[kind].splitlines()
    line = lines[at]
    lines[at] = line[:place] + new + line[place + instead :]
    path = tmp_path_factory.mktemp("spoilt") / "s.csv"
    path.write_bytes("\n".join([*lines, ""]).encode("utf-8", "surrogatepass"))
    try:
        found = read(path)
        t, y = (column.numbers() for column in found.columns)
    except BadInput as error:
        assert str(error).isprintable()  # noqa: PT017
        return
    if len(t) == N:
        others = np.arange(N) != at - 1
        np.testing.assert_array_equal(t[others], T[others])
        np.testing.assert_array_equal(y[others], Y[others])
    else:
        assert len(t) == N - 1
        assert found.remarks
        np.testing.assert_array_equal(t, np.delete(T, at - 1))
        np.testing.assert_array_equal(y, np.delete(Y, at - 1))
