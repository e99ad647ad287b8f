"""Plants of order 0: the response is the value itself, f(r) = M r + c."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mechanics import exert, respond

from fpt_ros.plants import mimo_affine, siso_affine

number = st.floats(-10.0, 10.0)


@given(number, number, number)
def test_one_dimension(alpha, beta, r):
    effort = exert(siso_affine.MODEL, (), (0.0,), (0.0,), (r,))
    assert effort == [r]
    assert respond(siso_affine.PLANT, (alpha, beta), (0.0,), (0.0,), effort) == [alpha * r + beta]


@given(number, number)
def test_two_dimensions_with_the_matrix_of_the_experiment(x, y):
    plant = mimo_affine.PLANT
    defaults = [parameter.default for parameter in plant.parameters]
    M, c = np.array([[3.832, 1.819], [1.819, 2.168]]), np.array([1.0, -1.0])
    effort = exert(mimo_affine.MODEL, (), (0.0, 0.0), (0.0, 0.0), (x, y))
    assert effort == [x, y]
    found = respond(plant, defaults, (0.0, 0.0), (0.0, 0.0), effort)
    assert found == pytest.approx(M @ [x, y] + c, abs=1e-13)


def test_their_order():
    assert siso_affine.PLANT.order == mimo_affine.PLANT.order == 0
