"""The claims of the thesis: what they use and cover, how they are found and named."""

import re
from collections.abc import Mapping

import pytest
from claims_of_the_thesis import CHAPTERS, CLAIMS
from figure_numbers import numbers

from fpt_ros.errors import BadInput
from fpt_ros.experiments.experiment import available, load
from fpt_ros.thesis.chapters import chapters, wanted
from fpt_ros.thesis.setup import Setup

DRAWN = numbers("2.1-2.33, 3.1-3.34, 4.3-4.6, 4.9-4.28, 5.2-5.3, 6.1-6.5")
"""The thesis's figures with results; the others are schemes (4.1, 4.2, 4.7, 4.8, 5.1)."""


def test_every_experiment_and_variant_of_the_thesis_is_used():
    setups = [s for claim in CLAIMS.values() for s in claim.runs.values() if isinstance(s, Setup)]
    used = {(setup.name, setup.variant) for setup in setups}
    there = {
        (name, variant)
        for name, variants in available().items()
        for variant in variants
        if not str(load(name, variant).about["thesis"]).startswith("not in it")
    }
    assert there - used == set()


def test_every_figure_with_results_is_drawn_and_claimed():
    drawn = {n for c in CLAIMS.values() for p in c.pictures for n in numbers(p.thesis)}
    claimed = {n for claim in CLAIMS.values() for n in numbers(claim.figures)}
    assert set(DRAWN) - drawn == set()
    assert set(DRAWN) - claimed == set()
    assert drawn <= set(DRAWN)


class NeedsRuns(Exception):
    """What follows of a picture can be drawn with runs only."""


class NoRuns(Mapping):
    def needed(self, *_):
        raise NeedsRuns

    __getitem__ = __iter__ = __len__ = needed


def test_pictures_that_need_no_runs_are_drawn():
    """``fpt reproduce`` broke over two of them when a law got one more constant."""
    drawn = []
    for name, claim in CLAIMS.items():
        for picture in claim.pictures:
            try:
                picture.draw(NoRuns())
            except NeedsRuns:
                continue
            drawn.append(name)
    assert len(drawn) >= 3, drawn


def test_a_chapter_is_found_by_its_file():
    assert set(CHAPTERS) <= set(chapters())
    for number, chapter in chapters().items():
        assert chapter.number == number
        assert chapter.title


def test_names_are_the_sections_with_a_letter():
    for name, claim in CLAIMS.items():
        assert name[:-1] == claim.section
        assert re.fullmatch(r"\d(\.\d)*[a-z]", name)
        assert claim.text.endswith(".")


def test_figure_ranges_are_spelt_out():
    assert numbers("2.1-2.3, 3.4") == ["2.1", "2.2", "2.3", "3.4"]
    assert numbers("") == []


@pytest.mark.parametrize("claim", CLAIMS.values(), ids=CLAIMS)
def test_every_run_of_a_claim_is_an_experiment(claim):
    seen = set()
    for setup in claim.runs.values():
        if not isinstance(setup, Setup):
            continue
        if (setup.name, setup.variant, len(setup.settings)) not in seen:  # scans: one of them
            seen.add((setup.name, setup.variant, len(setup.settings)))
            setup.experiment()


def test_chosen_claims_keep_the_order_of_the_page():
    chosen = wanted([], ["3.2.2a", "2.6a", "3.1.1b"])
    assert [(one.number, list(one.claims)) for one in chosen] == [
        (2, ["2.6a"]),
        (3, ["3.1.1b", "3.2.2a"]),
    ]
    assert list(wanted([3])[0].claims) == list(chapters()[3].claims)


def test_a_claim_that_is_not_there_is_bad_input():
    with pytest.raises(BadInput, match=r"^--claim 2\.2\.1z: .* nearest are 2\.2\.1"):
        wanted([], ["2.2.1z"])
    with pytest.raises(BadInput, match=r"^--claim 2\.6a: there is no such claim"):
        wanted([3], ["2.6a"])


def test_an_unknown_experiment_is_bad_input():
    with pytest.raises(BadInput, match="no experiment 'nothing'"):
        Setup("nothing").experiment()
