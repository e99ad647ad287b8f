"""The page of claims as its users make it."""

import json
import re
from itertools import chain

import pytest
import samples
from command import forked_fpt

from fpt_ros.thesis.chapters import chapters
from fpt_ros.thesis.claim import STATUSES

QUICK = ("3.1.1a", "3.2.1a", "3.2.2a")


def asked():
    """Claims on the page: a few; with ``--all`` the whole chapter."""
    claims = chapters()[3].claims
    return {name: claim for name, claim in claims.items() if samples.whole or name in QUICK}


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    out = tmp_path_factory.mktemp("reproduction") / "deep"
    out.mkdir()
    (out / "index.html").write_text("an older page")
    some = [] if samples.whole else [word for name in QUICK for word in ("--claim", name)]
    done = forked_fpt("reproduce", "--chapter", 3, *some, "--out", out, "--json")
    assert done.returncode == 0, done.stderr
    return out, json.loads(done.stdout), done.stderr


def test_every_claim_has_a_verdict_and_a_command(made):
    _, result, _ = made
    assert [claim["id"] for claim in result["claims"]] == list(asked())
    for claim in result["claims"]:
        assert claim["status"] in STATUSES
        assert claim["reason"]
        assert claim["measured"]
        assert all(line.startswith("fpt simulate ") for line in claim["runs"].values())
    assert sum(result["count"].values()) == len(result["claims"])


def test_verdicts_that_the_description_of_the_experiments_gives(made):
    status = {claim["id"]: claim["status"] for claim in made[1]["claims"]}
    assert status["3.1.1a"] == "only if"  # the printed x* is an iteration stopped too early
    assert status["3.2.1a"] == "no"  # the printed sign diverges
    assert status["3.2.2a"] == "yes"


def test_the_page_is_complete_in_itself(made):
    out, _, _ = made
    page = (out / "index.html").read_text()
    names = list(asked())
    assert re.findall(r'<article class="card claim \w+" id="claim-([\w.]+)"', page) == names
    pictures = list(chain(*(claim.pictures for claim in asked().values())))
    assert page.count("data:image/png;base64,") == len(pictures)
    assert "fpt simulate tora --variant nonadaptive" in page
    assert "prefers-color-scheme: dark" in page
    text = re.sub(r"base64,[A-Za-z0-9+/=]+", "", page)
    assert "http" not in text
    assert not re.findall(r'(?:src|href)="(?!data:|#)', text)
    assert len(page) < 15e6


def test_the_same_is_there_as_data(made):
    out, result, _ = made
    found = json.loads((out / "claims.json").read_text())
    assert found["claims"] == result["claims"]
    assert sorted(path.name for path in out.iterdir()) == ["claims.json", "index.html"]


def test_progress_is_on_stderr(made):
    assert made[2].startswith(f"reproduce: {len(asked())} claims")


def test_a_chapter_without_claims_is_bad_input(tmp_path):
    number = 99
    done = forked_fpt("reproduce", "--chapter", number, "--out", tmp_path / "out")
    assert done.returncode == 2
    assert re.fullmatch(rf"fpt: --chapter {number}: it takes one of 2, 3, 4.*\n", done.stderr)
    assert not (tmp_path / "out").exists()


def test_a_place_that_cannot_be_written_is_said_before_the_runs(tmp_path):
    (tmp_path / "file").write_text("")
    done = forked_fpt("reproduce", "--chapter", 2, "--out", tmp_path / "file" / "out")
    assert done.returncode == 2
    assert re.fullmatch(r"fpt: --out .*file is not a directory, give .*\n", done.stderr)
