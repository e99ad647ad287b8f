"""State files: whatever is torn is known, and what was whole before it counts."""

import mmap

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fpt_ros.nodes.state_file import StateFile


@given(
    st.lists(st.binary(max_size=3000), min_size=1, max_size=12),
    st.integers(2, 5),
)
def test_the_last_records_are_there_whatever_their_lengths(tmp_path_factory, records, slots):
    path = tmp_path_factory.mktemp("state") / "node.state"
    file = StateFile(path, slots)
    for record in records:
        file.add(record)
    assert StateFile(path, slots).records() == records[-slots:]
    again = StateFile(path, slots)
    again.add(b"one more")
    assert StateFile(path, slots).records() == [*records, b"one more"][-slots:]


@pytest.mark.parametrize("slots", [2, 4])
def test_a_write_that_was_cut_anywhere_leaves_the_record_before_it(tmp_path, slots):
    path = tmp_path / "node.state"
    file = StateFile(path, slots)
    records = [bytes([k]) * 40 for k in range(1, 9)]
    for record in records:
        file.add(record)
    before = path.read_bytes()
    file.add(b"\xff" * 40)
    after = path.read_bytes()
    changed = [at for at, pair in enumerate(zip(before, after, strict=True)) if pair[0] != pair[1]]
    for cut in range(changed[0], changed[-1] + 1):
        path.write_bytes(after[:cut] + before[cut:])
        found = StateFile(path, slots).records()
        assert found[-1] == records[-1]
        assert found == records[-len(found) :]
        assert len(found) >= slots - 1


def test_no_bit_may_be_another(tmp_path):
    path = tmp_path / "node.state"
    StateFile(path).add(b"first")
    StateFile(path).add(b"second")
    whole = path.read_bytes()
    start = whole.index(b"second") - 16
    for at in range(start, start + 16 + len(b"second")):
        path.write_bytes(whole[:at] + bytes([whole[at] ^ 1]) + whole[at + 1 :])
        assert StateFile(path).records() == [b"first"]


@pytest.mark.parametrize("content", [b"", b"fptstate", bytes(300), b"\xff" * 5000])
def test_a_file_of_something_else_is_no_state(tmp_path, content):
    path = tmp_path / "node.state"
    path.write_bytes(content)
    file = StateFile(path)
    assert file.records() == []
    file.add(b"new")
    assert StateFile(path).records() == [b"new"]


def test_it_is_read_while_it_is_mapped(tmp_path):
    """What was written is there without a call of the operating system."""
    path = tmp_path / "node.state"
    writer = StateFile(path)
    writer.add(b"one")
    with path.open("r+b") as file, mmap.mmap(file.fileno(), 0) as seen:
        writer.add(b"two")
        assert b"two" in seen[:]
