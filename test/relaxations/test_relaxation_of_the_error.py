"""(d/dt + Lambda)^n e = 0: what the desired response prescribes."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fpt_ros.relaxations import RELAXATIONS, combined_error


def law_of(name):
    """A relaxation as a function of Lambda, nominal response, e, e' and the integral."""
    law = RELAXATIONS[name]

    def prescribe(lam, *rest):
        return law.prescribe(law.prepare({"lambda": lam}), *rest)

    return prescribe


pd, pi, pid, value = map(law_of, ("pd", "pi", "pid", "value"))

number = st.floats(-10.0, 10.0)
rate = st.floats(0.1, 20.0)


@settings(deadline=None)
@given(rate, number, st.floats(0.0, 1.0))
def test_pd_lets_exp_and_t_exp_decay(lam, nominal, t):
    """e = exp(-Lambda t) and t exp(-Lambda t) solve (d/dt + Lambda)^2 e = 0: q'' = q''Des."""
    e = np.exp(-lam * t)
    for size, slope, bend in (
        (e, -lam * e, lam**2 * e),
        (t * e, (1 - lam * t) * e, (lam**2 * t - 2 * lam) * e),
    ):
        response = nominal - bend  # e = q^N - q
        desired = pd(lam, nominal, size, slope, 123.0)
        assert desired == pytest.approx(response, abs=1e-12 * (1 + lam**2 * 10))


@settings(deadline=None)
@given(rate, number, st.floats(0.0, 1.0))
def test_pid_lets_the_integral_decay(lam, nominal, t):
    """The integral of e may be exp, t exp or t^2 exp: e'' follows from (d/dt + Lambda)^3 = 0."""
    x = np.polynomial.Polynomial([0.0, 1.0])
    for power in range(3):
        factor = x**power
        derivatives = []
        for _ in range(4):
            derivatives.append(factor(t) * np.exp(-lam * t))
            factor = factor.deriv() - lam * factor
        integral, e, slope, bend = derivatives
        desired = pid(lam, nominal, e, slope, integral)
        assert desired == pytest.approx(nominal - bend, abs=1e-12 * (1 + 10 * lam**3))


@pytest.mark.parametrize(("law", "order"), [(pd, 2), (pid, 3)])
@pytest.mark.parametrize("lam", [1.0, 6.0, 10.0])
def test_characteristic_polynomial(law, order, lam):
    """The law's gains are the binomial coefficients of (s + Lambda)^n."""
    gains = [law(lam, 0.0, *unit) for unit in ((0, 1, 0), (1, 0, 0), (0, 0, 1))][:order]
    expected = np.poly([-lam] * order)
    assert [1.0, *gains] == pytest.approx(expected, rel=1e-14)
    assert law(lam, 7.0, 0.0, 0.0, 0.0) == 7.0


def test_the_order_that_each_prescribes():
    """A relaxation of another order than the plant's is refused, so the order has to be right."""
    orders = {name: RELAXATIONS[name].order for name in ("value", "pi", "pd", "pid")}
    assert orders == {"value": 0, "pi": 1, "pd": 2, "pid": 2}


@settings(deadline=None)
@given(rate, number, st.floats(0.0, 1.0))
def test_pi_lets_the_integral_decay(lam, nominal, t):
    """The integral of e may be exp or t exp: e' follows from (d/dt + Lambda)^2 = 0."""
    x = np.polynomial.Polynomial([0.0, 1.0])
    for power in range(2):
        factor = x**power
        derivatives = []
        for _ in range(3):
            derivatives.append(factor(t) * np.exp(-lam * t))
            factor = factor.deriv() - lam * factor
        integral, e, slope = derivatives
        desired = pi(lam, nominal, e, 123.0, integral)
        assert desired == pytest.approx(nominal - slope, abs=1e-12 * (1 + 10 * lam**2))


def test_the_value_itself_is_prescribed_where_nothing_can_decay():
    assert value(5.0, 7.0, 1.0, 2.0, 3.0) == 7.0


@settings(deadline=None)
@given(rate, st.floats(0.0, 1.0))
def test_the_combined_error_is_the_operator_squared_on_the_integral(lam, t):
    """S = (d/dt + Lambda)^2 of t^2 exp(-Lambda t) / 2 is exp(-Lambda t)."""
    decay = np.exp(-lam * t)
    integral = 0.5 * t * t * decay
    e = (t - 0.5 * lam * t * t) * decay
    slope = (1 - 2 * lam * t + 0.5 * lam**2 * t * t) * decay
    assert combined_error(lam, e, slope, integral) == pytest.approx(decay, abs=1e-13 * (1 + lam**2))
