import pytest

from fpt_ros.errors import BadInput
from fpt_ros.sweep.journal import Journal


def open_(path, size=5):
    return Journal(path, size, 3, 1)


def test_rows_come_back_by_number(tmp_path):
    with open_(tmp_path / "j") as journal:
        journal.append([[3, "complete", 0.1 + 0.2], [0, "diverged", None]])
        assert list(journal.missing()) == [1, 2, 4]
    with open_(tmp_path / "j") as journal:
        assert list(journal.rows()) == [[0, "diverged", None], [3, "complete", 0.1 + 0.2]]
        assert (journal.done, journal.lost) == (2, 1)


def test_every_torn_end_is_done_again(tmp_path):
    path = tmp_path / "j"
    with open_(path) as journal:
        journal.append([[0, "complete", 1.5], [1, "complete", 2.5]])
    whole = path.read_bytes()
    first = whole.index(b"\n") + 1
    for end in range(first, len(whole)):
        path.write_bytes(whole[:end])
        with open_(path) as journal:
            assert list(journal.rows()) == [[0, "complete", 1.5]]
            journal.append([[1, "complete", 2.5]])
        assert path.read_bytes() == whole


def test_a_row_counts_once(tmp_path):
    with open_(tmp_path / "j") as journal:
        journal.append([[1, "complete", 1.0]])
        journal.append([[1, "complete", 2.0], [2, "complete", 3.0]])
        assert list(journal.rows()) == [[1, "complete", 1.0], [2, "complete", 3.0]]


def test_one_writer(tmp_path):
    with open_(tmp_path / "j"), pytest.raises(BadInput, match="another fpt sweep"):
        open_(tmp_path / "j")
