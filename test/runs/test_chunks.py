"""A run chunk by chunk: pieces, and the messages in the order of events."""

import numpy as np
import pytest
from engine_runs import frames_of, topics_of

from fpt_ros.experiments import experiment
from fpt_ros.runs.chunks import CHUNK, Pieces, frames, joined, rows
from fpt_ros.runs.run import Series


def series(stamps, names=("a",)):
    stamps = np.array(stamps, dtype=np.int64)
    values = np.repeat(stamps[:, None], len(names), axis=1).astype(float)
    return Series(stamps, names, {"values": values})


def stamps_of(pieces):
    return [{name: each.stamps.tolist() for name, each in piece.items()} for piece in pieces]


@pytest.mark.parametrize("size", [1, 5, CHUNK - 1, CHUNK, CHUNK + 1, 3 * CHUNK, 10**6])
def test_pieces_do_not_depend_on_the_chunks(size):
    count = 2 * CHUNK + 100 if size > 5 else 30
    whole = series(7 + 10 * np.arange(count))
    got = []
    pieces = Pieces(10, lambda piece: got.append(piece["x"].stamps.copy()))
    for first in range(0, count, size):
        pieces.take({"x": rows(whole, first, first + size)})
    pieces.finish()
    assert [len(each) for each in got] == ([CHUNK, CHUNK, 100] if size > 5 else [30])
    assert np.array_equal(np.concatenate(got), whole.stamps)


def test_topics_are_cut_at_the_same_time_and_gaps_cost_nothing():
    far = 10**18
    got = []
    pieces = Pieces(1, got.append)
    pieces.take({"x": series([0, 1, CHUNK - 1, CHUNK, far]), "y": series([CHUNK + 5, far])})
    pieces.finish()
    assert stamps_of(got) == [
        {"x": [0, 1, CHUNK - 1]},
        {"x": [CHUNK], "y": [CHUNK + 5]},
        {"x": [far], "y": [far]},
    ]


def test_what_waits_outlives_the_arrays_that_it_came_in():
    got = []
    pieces = Pieces(1, got.append)
    again = series([0, 1, 2])
    pieces.take({"x": again})
    again.vectors["values"][:] = -1.0
    again.stamps[:] = (3, 4, 5)
    pieces.take({"x": again})
    pieces.finish()
    assert stamps_of(got) == [{"x": [0, 1, 2, 3, 4, 5]}]
    assert got[0]["x"].vectors["values"][:, 0].tolist() == [0, 1, 2, -1, -1, -1]


def test_series_with_different_names_are_joined_by_name():
    whole = joined([series([1], ("a",)), series([2], ("b", "a"))])
    assert whole.names == ("a", "b")
    assert np.array_equal(whole.vectors["values"], [[1, np.nan], [2, 2]], equal_nan=True)


@pytest.mark.parametrize("name", ["vdp_rfpt", "swing"])
def test_frames_of_chunks_are_those_of_the_loop_in_the_order_of_events(name):
    duration = {"vdp_rfpt": 0.02, "swing": 2.01}[name]
    topics = topics_of(name, duration=duration)
    expected = frames_of(experiment.load(name, duration=duration).loop())
    found = []
    for first in range(0, len(topics["command"].stamps), 700):
        chunk = {key: rows(each, first, first + 700) for key, each in topics.items()}
        found += frames(chunk, sharing=name == "swing")
    assert len(found) == len(expected)
    # as text, in which NaN is equal to itself and no digit is lost
    assert all(
        one is other and text(f) == text(g)
        for (one, f), (other, g) in zip(found, expected, strict=True)
    )


def text(frame):
    return repr((*frame[:2], *map(list, frame[2:])))
