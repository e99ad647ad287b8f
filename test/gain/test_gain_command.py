"""``fpt gain`` as its users call it."""

import pytest
from command import forked_fpt as fpt
from command import forked_fpt_json as fpt_json


def test_command(tmp_path):
    picture = tmp_path / "gain.svg"
    result = fpt_json("gain", "siso_affine", "--plot", picture)
    assert result["range"] == pytest.approx([-3.1609018044, 0.0])
    assert result["behaviour"] == "monotone"
    assert result["contracts"] is True
    assert [row["behaviour"] for row in result["behaviours"]] == [
        "runs away",
        "monotone",
        "precursor oscillation",
        "two-cycle",
        "period doubling",
        "chaos",
        "leaves the domain",
    ]
    assert result["run"]["complete"] is True
    assert picture.read_text().lstrip().startswith("<?xml")
    done = fpt("gain", "mimo_affine", "--out", tmp_path / "new")
    assert done.returncode == 0, done.stderr
    assert "contracts for A in (-0.6321492, 0)" in done.stdout
    assert (tmp_path / "new" / "gain.png").read_bytes()[:4] == b"\x89PNG"
    assert {path.name for path in (tmp_path / "new").iterdir()} == {
        "gain.png",
        "gain.svg",
        "gain.json",
    }


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        (["tora", "--variant", "nonadaptive"], "has no fixed point transformation"),
        (["tora", "--plot", "x.gif"], "it takes a name that ends with .png or .svg"),
        (["siso_affine", "--plot", "/proc/x.png"], "cannot write /proc/x.png"),
    ],
)
def test_bad_input_is_one_line(arguments, complaint):
    done = fpt("gain", *arguments)
    assert done.returncode == 2
    assert complaint in done.stderr
    assert len(done.stderr.strip().splitlines()) == 1
    assert done.stdout == ""
