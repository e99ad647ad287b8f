"""Model ``mujoco_linear``: against Pinocchio, against itself, and the property that proofs need."""

import numpy as np
import pytest
from test_arms_that_ship import model_of, torque
from test_files import URDF

from fpt_ros.errors import BadInput
from fpt_ros.parameters import resolve
from fpt_ros.plants import MODELS
from fpt_ros.plants.mujoco.description_file import ARMS, shipped
from fpt_ros.plants.mujoco.regressor import NUMBERS

pytest.importorskip("mujoco")

LINEAR = MODELS["mujoco_linear"]


def linear(file, n, **given):
    given = {"file": str(file), "K_D": [0.0] * n, **given}
    return LINEAR.make(resolve(LINEAR.parameters, given, "model"))


def effort(model, q, v, a, s):
    out = [np.nan] * len(q)
    model.effort(model.coefficients(()), *map(list, (q, v, a, s)), out)
    return np.array(out)


def matrix(model, q, v, w, a):
    out = [np.nan] * (len(q) * len(model.coefficient_names))
    model.regressor(model.coefficients(()), *map(list, (q, v, w, a)), out)
    return np.array(out).reshape(len(q), -1)


def theta(model):
    return np.array(model.coefficients(())[: len(model.coefficient_names)])


@pytest.mark.parametrize("arm", shipped())
def test_at_the_velocity_itself_it_is_the_inverse_dynamics_of_pinocchio(arm):
    pin = pytest.importorskip("pinocchio")
    theirs = pin.buildModelFromMJCF(str(ARMS / f"{arm}.xml"))
    data, n, rng = theirs.createData(), theirs.nq, np.random.default_rng(8)
    model = linear(arm, n)
    assert len(model.coefficient_names) == 13 * n
    for _ in range(20):
        q, v, a = rng.uniform(-3, 3, (3, n))
        expected = pin.rnea(theirs, data, q, v, a)
        assert np.abs(effort(model, q, v, a, np.zeros(n)) - expected).max() < 1e-9
        assert np.abs(matrix(model, q, v, v, a) @ theta(model) - expected).max() < 1e-9


def test_a_tree_with_a_joint_that_slides(tmp_path):
    """Beside MuJoCo's own recursion, with a tool and friction."""
    path = tmp_path / "tree.urdf"
    path.write_text(URDF)
    given = {"viscous": 1.0, "coulomb": 1.0, "tool": 2.0, "scale": 0.7}
    ours, theirs = linear(path, 3, **given), model_of(str(path), **given)
    rng = np.random.default_rng(9)
    for _ in range(20):
        q, v, a = rng.uniform(-1, 1, (3, 3))
        expected = torque(theirs, list(q), list(v), list(a))
        assert effort(ours, q, v, a, np.zeros(3)) == pytest.approx(expected, abs=1e-11)


@pytest.mark.parametrize("file", ["panda", "tree"])
def test_half_the_change_of_m_is_c(tmp_path, file):
    """x . (M' - 2 C) x = 0 for every x, on which the proof of Slotine and Li rests."""
    if file == "tree":
        file = tmp_path / "tree.urdf"
        file.write_text(URDF)
    n = 7 if file == "panda" else 3
    model, rng, step = linear(file, n), np.random.default_rng(10), 1e-6
    own = theta(model)
    for _ in range(10):
        q, v, x = rng.uniform(-1, 1, (3, n))
        zero = np.zeros(n)

        def weight(a, q, zero=zero):
            """M a."""
            return (matrix(model, q, zero, zero, a) - matrix(model, q, zero, zero, zero)) @ own

        changed = (weight(x, q + step * v) - weight(x, q - step * v)) / (2.0 * step)
        C_x = (matrix(model, q, v, x, zero) - matrix(model, q, zero, zero, zero)) @ own
        assert x @ changed == pytest.approx(2.0 * x @ C_x, rel=1e-7, abs=1e-7)


def test_the_combined_error_moves_the_reference_and_is_fed_back():
    gains = [5.0, 4.0, 3.0, 2.0, 1.0, 0.5, 0.2]
    model, rng = linear("panda", 7, K_D=gains, viscous=1.0, coulomb=1.0), np.random.default_rng(11)
    q, v, a, s = rng.uniform(-1, 1, (4, 7))
    expected = matrix(model, q, v, v + s, a) @ theta(model) + gains * s
    assert effort(model, q, v, a, s) == pytest.approx(expected, abs=1e-12)


def test_a_joint_that_is_not_prescribed_is_not_accelerated():
    model, rng = linear("panda", 7), np.random.default_rng(12)
    q, v, a = rng.uniform(-1, 1, (3, 7))
    a[3] = 0.0
    asked = np.where(np.arange(7) == 3, np.nan, a)
    assert effort(model, q, v, asked, np.zeros(7)).tolist() == (
        effort(model, q, v, a, np.zeros(7)).tolist()
    )


def test_its_numbers_are_those_of_the_file():
    model = linear("panda", 7, scale=0.5, coulomb=1.0)
    found = dict(zip(model.coefficient_names, theta(model), strict=True))
    assert found["joint1.m"] == pytest.approx(0.5 * 4.970684)
    assert found["joint1.armature"] == pytest.approx(0.5 * 0.1)
    assert found["joint1.coulomb"] == pytest.approx(0.55)
    assert list(found)[: len(NUMBERS)] == [f"joint1.{each}" for each in NUMBERS]


def test_a_gain_for_each_joint():
    with pytest.raises(BadInput, match=r"K_D: 2 numbers given, 7 needed \(joint1, "):
        linear("panda", 7, K_D=[1.0, 2.0])
