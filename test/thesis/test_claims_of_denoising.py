"""Claims of chapters 5 to 7: quick ones are made, the others' judges see numbers made by hand."""

import numpy as np
import pytest
from claims_of_the_thesis import CLAIMS as ALL
from claims_of_the_thesis import judged, performed

from fpt_ros.thesis.chapter5.s5_1_3_table_5_1 import THESIS
from fpt_ros.thesis.claim import NO, ONLY_IF, YES
from fpt_ros.thesis.commands import commands
from fpt_ros.thesis.trials import Scores

CLAIMS = {name: claim for name, claim in ALL.items() if name[0] in "567"}


def scores(snr=10.0, rmse=0.1, seconds=0.001):
    x = np.zeros(4)
    one = np.ones(2)
    return Scores(x, x, x, snr * one, rmse * one, one, rmse * one, seconds * one, seeds=range(2))


@pytest.mark.parametrize(
    ("name", "status"),
    [("5.1a", ONLY_IF), ("5.1.3b", ONLY_IF), ("5.1.3c", YES), ("5.1.3d", NO), ("5.2a", ONLY_IF),
     ("6.1a", YES),     ("6.1b", YES), ("6.2.1a", NO), ("6.2.2a", ONLY_IF), ("6.2.2b", ONLY_IF)],
)  # fmt: skip
def test_verdicts(name, status):
    assert judged(name).status == status


def test_rules_as_printed_lose_what_the_chapter_file_says():
    """10 other seeds there: 4.3 against 13.6 dB universal, 0.3 against 8.3 SURE."""
    found = judged("5.1a").measured
    assert found["universal (5.1): as printed [dB]"] == pytest.approx(4.3, abs=1.0)
    assert found["universal (5.1): corrected [dB]"] == pytest.approx(13.6, abs=0.3)
    assert found["SureShrink (5.2): as printed [dB]"] == pytest.approx(0.3, abs=0.3)
    assert found["SureShrink (5.2): corrected [dB]"] == pytest.approx(8.3, abs=0.3)


def test_table_51_of_the_thesis():
    """The chapter file: 22.4, 3.8 to 4.1, 5.3 to 5.6, 3.7 to 4.2 dB at rho = 0.9."""
    claim = CLAIMS["5.1.3a"]
    runs = {
        key: performed(trial) for key, trial in claim.runs.items() if key.split(",")[0] in THESIS
    }
    found = {key: one.mean("snr") for key, one in runs.items()}
    assert found["improved, 0.9"] == pytest.approx(22.4, abs=0.3)
    assert found["sureshrink, 0.9"] == pytest.approx(3.9, abs=0.3)
    assert found["minimax, 0.9"] == pytest.approx(5.4, abs=0.3)
    assert found["heursure, 0.9"] == pytest.approx(3.9, abs=0.4)
    assert found["improved, 0.5"] == pytest.approx(17.2, abs=0.4)
    assert found["heursure, 0.5"] == pytest.approx(13.2, abs=0.4)
    assert found["sureshrink, 0.5"] == pytest.approx(8.3, abs=0.4)
    assert found["minimax, 0.5"] == pytest.approx(10.8, abs=0.4)


def test_verdicts_follow_the_numbers():
    claim = CLAIMS["5.1.3a"]
    equal = {key: scores() for key in claim.runs}
    assert claim.judge(equal).status == NO
    assert claim.judge({**equal, "improved, 0.5": scores(20.0), "improved, 0.9": scores(60.0)}
    ).status == YES  # fmt: skip
    fuzzy = CLAIMS["5.1.1a"]
    good = {key: scores(20.0 if "fuzzy" in key else 10.0) for key in fuzzy.runs}
    assert fuzzy.judge(good).status == YES
    assert fuzzy.judge({key: scores() for key in fuzzy.runs}).status == NO
    rounds = CLAIMS["6.2.3a"]
    perfect = {key: scores(rmse=1e-9 if "adaptive" in key else 0.1) for key in rounds.runs}
    assert rounds.judge(perfect).status == YES
    kinds = CLAIMS["6.2.1b"]
    assert kinds.judge({key: scores() for key in kinds.runs}).status == YES


@pytest.mark.parametrize("name", CLAIMS)
def test_commands_name_every_signal_and_method(name):
    lines = "\n".join(commands(CLAIMS[name]))
    for source in CLAIMS[name].runs.values():
        if hasattr(source, "noisy"):
            assert source.noisy.text("$s").removesuffix(",seed=$s") in lines
            assert f"--method {source.method}" in lines


def test_noise_loses_the_raw_loop_and_not_the_synchronised_one():
    claim = CLAIMS["7a"]
    wanted = [key for key in claim.runs if key.endswith(("0.0001", ", 0"))]
    runs = {key: performed(claim.runs[key]) for key in wanted}
    late = {key: runs.get(key, runs[f"{key.rpartition(',')[0]}, 0.0001"]) for key in claim.runs}
    verdict = claim.judge(late)
    assert verdict.status == YES
    assert verdict.measured["finite differences, sigma = 0.0001"] == "lost at 1.36 s"
    assert verdict.measured["synchronised, sigma = 0.0001: q3 [m]"] <= 5e-5
    assert len(verdict.table.rows) == len(claim.runs)
    quiet = {key: runs[f"{key.rpartition(',')[0]}, 0"] for key in claim.runs}
    assert claim.judge(quiet).status == NO
