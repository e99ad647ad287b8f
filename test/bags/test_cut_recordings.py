"""What is left of a recording that was cut or damaged."""

from pathlib import Path

import numpy as np
import pytest
import samples
from hypothesis import given, settings
from hypothesis import strategies as st
from mcap.reader import make_reader
from messages_made import same
from recorded_run import Recorded

from fpt_ros.bags import reader
from fpt_ros.errors import BadInput
from fpt_ros.runs.run import Run


def open_cut(recorded: Recorded, data: bytes, path: Path) -> Run | None:
    path.write_bytes(data)
    refused = ""
    try:
        return reader.read_run(path)
    except BadInput as error:
        refused = str(error)
    assert "\n" not in refused
    assert str(path) in refused
    return None


@settings(deadline=None, max_examples=300 if samples.whole else 60)
@given(data=st.data())
def test_cut_anywhere_gives_a_prefix(
    recorded: Recorded, tmp_path_factory: pytest.TempPathFactory, data: st.DataObject
) -> None:
    whole = recorded.file.read_bytes()
    with recorded.file.open("rb") as stream:
        summary = make_reader(stream).get_summary()
    assert summary is not None
    parameters = summary.attachment_indexes[0].offset + summary.attachment_indexes[0].length
    chunks = [
        index.chunk_start_offset + index.chunk_length
        for index in sorted(summary.chunk_indexes, key=lambda index: index.chunk_start_offset)
    ]
    marks = [parameters, *chunks, len(whole)]
    position = data.draw(
        st.one_of(
            st.integers(0, len(whole)),
            st.integers(0, 4096),
            st.sampled_from(marks).flatmap(lambda m: st.integers(m - 20, min(m + 20, len(whole)))),
        )
    )
    run = open_cut(recorded, whole[:position], tmp_path_factory.getbasetemp() / "cut.mcap")
    assert (run is not None) == (position >= parameters)
    if run is None:
        return
    expected = recorded.topics
    for name, series in run.topics.items():
        same(series, expected[name], len(series.stamps))
    count = sum(len(series.stamps) for series in run.topics.values())
    if position >= chunks[-1]:
        assert count == len(recorded.frames)
    else:
        assert (run.info["complete"], run.info["reason"]) == ("false", "the recording was cut")
        assert (count > 0) == (position >= chunks[0])
    assert run.parameters == recorded.parameters


@settings(deadline=None, max_examples=200 if samples.whole else 60)
@given(data=st.data())
def test_damage_anywhere_is_never_another_error(
    recorded: Recorded, tmp_path_factory: pytest.TempPathFactory, data: st.DataObject
) -> None:
    whole = bytearray(recorded.file.read_bytes())
    position = data.draw(st.one_of(st.integers(0, 5000), st.integers(0, len(whole) - 1)))
    patch = data.draw(st.binary(min_size=1, max_size=12))
    whole[position : position + len(patch)] = patch
    open_cut(recorded, bytes(whole), tmp_path_factory.getbasetemp() / "damaged.mcap")


def test_damaged_chunk(recorded: Recorded, tmp_path: Path) -> None:
    whole = bytearray(recorded.file.read_bytes())
    with recorded.file.open("rb") as stream:
        summary = make_reader(stream).get_summary()
    assert summary is not None
    chunks = sorted(summary.chunk_indexes, key=lambda index: index.chunk_start_offset)
    hit = max(chunks[1:-1], key=lambda index: index.chunk_length)
    second = hit.chunk_start_offset
    whole[second + hit.chunk_length // 2] ^= 0xFF
    path = tmp_path / "damaged.mcap"
    path.write_bytes(whole)
    run = reader.read_run(path)
    assert (run.info["complete"], run.info["reason"]) == ("false", "the recording is damaged")
    assert f"the chunk at byte {second}, messages from " in run.info["missing"]
    found, whole_series = run.topics["joint_states"], recorded.topics["joint_states"]
    assert 0 < len(found.stamps) < 1000
    assert found.stamps[-1] == whole_series.stamps[-1]  # those behind the chunk are read too
    there = np.isin(whole_series.stamps, found.stamps)
    for name, numbers in found.vectors.items():
        assert numbers.tobytes() == whole_series.vectors[name][there].tobytes()


def test_end_of_a_file_that_the_power_failed_on(recorded: Recorded, tmp_path: Path) -> None:
    path = tmp_path / "zeros.mcap"
    path.write_bytes(recorded.file.read_bytes()[:50_000] + bytes(10_000))
    assert reader.read_run(path).info["complete"] == "false"
