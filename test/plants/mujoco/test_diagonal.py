"""Model ``mujoco_diagonal``: constant inertias, and gravity as Pinocchio has it."""

import numpy as np
import pytest

from fpt_ros.errors import BadInput
from fpt_ros.parameters import resolve
from fpt_ros.plants import MODELS
from fpt_ros.plants.mujoco.description_file import ARMS

pytest.importorskip("mujoco")

INERTIA = [1.0, 2.0, 0.5, 0.4, 0.3, 0.2, 0.1]
DIAGONAL = MODELS["mujoco_diagonal"]


def effort(q, v, r, **given):
    values = {"file": "panda", "inertia": INERTIA, **given}
    model = DIAGONAL.make(resolve(DIAGONAL.parameters, values, "model"))
    out = [np.nan] * 7
    model.effort(model.coefficients(()), *map(list, (q, v, r)), [0.0] * 7, out)
    return np.array(out)


def test_inertias_alone():
    q, v, r = np.random.default_rng(3).uniform(-1, 1, (3, 7))
    r[2] = np.nan  # not controlled
    assert effort(q, v, r).tolist() == [
        0.0 if np.isnan(x) else m * x for m, x in zip(INERTIA, r, strict=True)
    ]


def test_gravity_of_half_of_the_masses():
    pin = pytest.importorskip("pinocchio")
    theirs = pin.buildModelFromMJCF(str(ARMS / "panda.xml"))
    data, rng = theirs.createData(), np.random.default_rng(4)
    for _ in range(20):
        q, v, r = rng.uniform(-2, 2, (3, 7))
        gravity = pin.computeGeneralizedGravity(theirs, data, q)
        expected = 0.5 * gravity + INERTIA * r
        assert effort(q, v, r, scale=0.5, gravity=True) == pytest.approx(expected, abs=1e-10)


def test_an_inertia_for_each_joint():
    with pytest.raises(BadInput, match=r"inertia: 1 numbers given, 7 needed \(joint1, "):
        effort([0.0] * 7, [0.0] * 7, [0.0] * 7, inertia=[1.0])
