"""``fpt reproduce``: every claim is judged, and one page holds them all."""

import json
import re
import shlex
import signal
import subprocess

import psutil
import pytest
from command import BIN, fpt, start_fpt

from fpt_ros.analysis.claims import chapters
from fpt_ros.loop.experiment import available

CLAIMS = {name: claim for chapter in chapters().values() for name, claim in chapter.claims.items()}


def numbers(text):
    """Figure numbers of a text such as ``2.15, 2.17-2.19``."""
    found = set()
    for chapter, first, last in re.findall(r"(\d)\.(\d+)(?:-\d\.(\d+))?", text):
        found |= {f"{chapter}.{n}" for n in range(int(first), int(last or first) + 1)}
    return found


def test_every_experiment_and_variant_of_chapters_2_to_4_is_run():
    run = {(one.name, one.variant) for claim in CLAIMS.values() for one in claim.runs.values()}
    assert {(n, v) for n, vs in available().items() for v in vs if n != "noisy_tora"} <= run


def test_every_figure_with_results_belongs_to_a_claim():
    claimed = set()
    for claim in CLAIMS.values():
        claimed |= numbers(claim.figures)
        for picture in claim.pictures:
            claimed |= numbers(picture.thesis)
    assert numbers("2.1-2.33, 3.4-3.34, 4.3-4.6, 4.10-4.28") <= claimed


def test_a_chapter_makes_one_page_with_verdicts_figures_and_commands(tmp_path):
    done = fpt("reproduce", "--chapter", 4, "--out", tmp_path, "--json", timeout=280)
    assert done.returncode == 0, done.stderr
    result = json.loads(done.stdout)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["claims.json", "index.html"]
    page = (tmp_path / "index.html").read_text(encoding="utf-8")
    claims = chapters()[4].claims
    for claim in claims.values():
        for one in claim.runs.values():
            assert f"fpt simulate {one.name}" in page
    assert page.count("data:image/png;base64,") >= len(claims)
    text = json.dumps(result)
    assert text.count('"yes"') >= 5
    assert '"only if"' in text


def test_a_command_of_a_claim_repeats_its_run():
    setup = next(one for claim in CLAIMS.values() for one in claim.runs.values() if one.settings)
    done = fpt(*shlex.split(setup.command())[1:], "--json")
    assert done.returncode in (0, 1), done.stderr
    assert json.loads(done.stdout)["experiment"] == setup.name


@pytest.mark.parametrize("chapter", ["1", "x"])
def test_a_chapter_without_experiments_is_refused(tmp_path, chapter):
    done = fpt("reproduce", "--chapter", chapter, "--out", tmp_path / "out")
    assert done.returncode == 2
    assert len(done.stderr.strip().splitlines()) == 1
    assert not (tmp_path / "out").exists()


def test_interrupted_it_leaves_nothing_behind(tmp_path):
    process = start_fpt("reproduce", "--chapter", 2, "--out", tmp_path / "out")
    parent = psutil.Process(process.pid)
    assert process.stderr.readline().startswith("reproduce:")  # the workers have been asked for
    children = parent.children(recursive=True)
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=60)
    assert process.returncode == 130
    _, alive = psutil.wait_procs(children, timeout=10)
    assert not alive
    assert not (tmp_path / "out").exists()


def test_help_has_an_example():
    done = subprocess.run([BIN / "fpt", "reproduce", "-h"], capture_output=True, text=True)
    assert "Example: fpt reproduce" in done.stdout
