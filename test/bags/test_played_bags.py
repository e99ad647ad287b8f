"""A recording chunk by chunk."""

import numpy as np
import pytest

from fpt_ros.analysis.metrics import summary
from fpt_ros.analysis.recorded import read_outline, read_summary
from fpt_ros.bags import reader
from fpt_ros.bags.reader import play, read_run
from fpt_ros.runs.chunks import joined


@pytest.fixture(autouse=True)
def small_chunks(monkeypatch):
    monkeypatch.setattr(reader, "CHUNK", 170)


def test_the_chunks_of_a_recording_are_the_recording(recorded):
    taken = []

    class Keep:
        def take(self, chunk):
            taken.append(chunk)

    about, whole = (
        play(recorded.directory, lambda parameters: [Keep()]),
        read_run(recorded.directory),
    )
    assert (about.info, about.parameters, about.topics) == (whole.info, whole.parameters, {})
    assert len(taken) > 4
    for name, series in whole.topics.items():
        again = joined([chunk[name] for chunk in taken if name in chunk])
        assert np.array_equal(again.stamps, series.stamps)
        for key, matrix in series.vectors.items():
            assert np.array_equal(again.vectors[key], matrix, equal_nan=True)
    for chunk in taken:  # whole cycles
        assert len({len(series.stamps) for series in chunk.values()}) == 1


def test_a_recording_has_the_numbers_of_its_run(recorded):
    expected = summary(read_run(recorded.directory))
    assert read_summary(recorded.directory) == expected
    found = read_outline(recorded.directory)
    whole = {**expected, "performance": None, "costs": []}  # no processes, so no costs
    assert {**found.numbers, "performance": None} == whole
    assert found.numbers["performance"]["q3"].keys() >= {"iae", "ise", "energy"}
    assert list(found.motions) == ["q3", "q2"]
