"""What is said of a gain before a run: of those outside the range, and of no other."""

from command import forked_fpt as fpt

from fpt_ros.experiments.experiment import available, load
from fpt_ros.gain.warning import known
from fpt_ros.gain.warning import warning as warning_of

OUTSIDE = {
    ("kapitza", "listing"): "outside the range (-5.071, 0)",
    ("kapitza", "with_gravity"): "outside the range (-5.071, 0)",
    ("kapitza", "offset"): "in a part of the nominal motion",
    ("siso_affine", "chaos"): "in chaos",
    ("mimo_affine", "printed_sign"): "runs away",
    ("tora", "strong"): "may chatter",
    ("tora", "chatter"): "may chatter",
    ("panda", "noisy"): "may chatter",
}

ALIKE = ("iiwa", "ur5e")
"""Arms with the settings of panda."""


def warning(experiment):
    return warning_of(experiment, known(experiment))


def test_only_those_warn_whose_gain_is_outside():
    for name, variants in available().items():
        for variant in variants if name not in ALIKE else ():
            text = warning(load(name, variant))
            if (name, variant) in OUTSIDE:
                assert OUTSIDE[name, variant] in text
                assert f"fpt gain {name} --variant {variant}" in text
                assert "\n" not in text
            else:
                assert text == "", (name, variant)


def test_warning_names_the_range_and_the_hard_onset():
    assert warning(load("tora", settings=["fpt_deformer.A=-5"])) == (
        "fpt_deformer.A = -5 is outside the range (-4.658, 0) in which the iteration contracts: it "
        "chatters in a two-cycle (a hard onset of chattering at -2.947; fpt gain tora)"
    )
    assert "runs away" in warning(load("tora", settings=["fpt_deformer.A=0.1"]))


def test_the_guard_of_the_precursor_needs_no_warning():
    assert warning(load("tora", "guarded")) == ""


def test_eigenvalues_of_both_signs_leave_no_gain():
    text = warning(load("mimo_affine", settings=["plant_simulator.exact.m22=-2.0"]))
    assert "no fpt_deformer.A contracts" in text


def test_simulate_warns_on_standard_error_only():
    done = fpt("simulate", "siso_affine", "--variant", "chaos", "--duration", 200, "--json")
    assert done.returncode == 0, done.stderr
    assert done.stderr.count("fpt: warning: fpt_deformer.A = -6 is outside the range") == 1
    assert "warning" not in done.stdout
    assert "warning" not in fpt("simulate", "siso_affine", "--duration", 200).stderr
