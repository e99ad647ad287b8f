"""A two-link arm of a user's own, and every usual mistake in it: one line, file, law, remedy."""

import itertools
import json
import shutil

import numpy as np
import own_package
import pytest

from fpt_ros import notices, registry
from fpt_ros.engine import compiled
from fpt_ros.engine import engine as engine_module
from fpt_ros.engine.engine import Engine
from fpt_ros.errors import BadInput
from fpt_ros.experiments import experiment

ARM = """
import math
import random
import time

import numpy as np

from fpt_ros.laws import norm
from fpt_ros.parameters import Parameter
from fpt_ros.plants import Model, Plant

PARAMETERS = (Parameter("m", "mass", 1.0, unit="kg"), Parameter("l", "length", 0.5, unit="m"))
GRAVITY = 9.81
TABLE = [9.81, 1.62]
count = 0


def weight(q):
    return GRAVITY * math.sin(q)


def grow():
    global count
    count += 1


def response(c, q, v, effort, out):
    mll = c[0] * c[1] * c[1]
    coupling = mll * math.cos(q[1])
    a, b = 3.0 * mll + 2.0 * coupling, mll + coupling
    x = effort[0] - weight(q[0]) - 0.1 * v[0]
    y = effort[1] - weight(q[1]) - 0.1 * v[1]
    determinant = a * mll - b * b
    out[0] = (mll * x - b * y) / determinant
    out[1] = (a * y - b * x) / determinant
    # MISTAKE


def effort(c, q, v, r, s, out):
    mll = c[0] * c[1] * c[1]
    coupling = mll * math.cos(q[1])
    out[0] = (3.0 * mll + 2.0 * coupling) * r[0] + (mll + coupling) * r[1]
    out[1] = (mll + coupling) * r[0] + mll * r[1]


ARM = Plant(("q1", "q2"), ("rad", "rad"), ("N m", "N m"), PARAMETERS, tuple, response)
MODEL = Model(("q1", "q2"), ("q1", "q2"), PARAMETERS, ("m", "l"), tuple, effort)
"""

FILE = """
/**/plant_simulator:
  ros__parameters: {plant: arm, exact: {m: 1.0, l: 0.5}, dt: 0.001, duration: 0.05}
/**/denoiser:
  ros__parameters: {method: none}
/**/trajectory_generator:
  ros__parameters: {controlled: [q1, q2], trajectory: sine, amplitude: [0.8, 0.5],
    frequency: [3.0, 4.0], lambda: 6.0}
/**/parameter_tuner:
  ros__parameters: {method: none}
/**/fpt_deformer:
  ros__parameters: {transformation: none}
/**/recorder:
  ros__parameters: {title: an arm}
/**:
  ros__parameters: {model: arm, approximate: {m: 0.9, l: 0.5}}
"""

LINE = ARM.splitlines().index("    # MISTAKE") + 1
FIRST = ARM.splitlines().index("def response(c, q, v, effort, out):") + 1

REFUSED = {
    "one output too many": ("out[2] = 0.0", LINE, "writes out[2], there is only [0] to [1]"),
    "one input too many": ("out[1] += v[2]", LINE, "reads v[2], there is only [0] to [1]"),
    "a list returned": ("return [out[0], out[1]]", FIRST, "returns a list: its results are"),
    "an exception": ("raise ValueError('no')", LINE, "write NaN instead"),
    "an exception that does not happen": ("if q[0] > 99.0: raise ValueError", LINE, "write NaN"),
    "an assertion": ("assert q[0] < 99.0", LINE, "write NaN instead"),
    "a slice": ("x = max(q[0:2])", LINE, "takes a slice: read and write number by number"),
    "a slice written": ("out[:] = [0.0, 0.0]", LINE, "takes a slice"),
    "a power": ("out[0] += x ** 3", LINE, "write x * x"),
    "a power of math": ("out[0] += math.pow(x, 3)", LINE, "products, x * x"),
    "hypot": ("out[0] += math.hypot(x, y)", LINE, "math.sqrt(x * x + y * y)"),
    "a sum": ("out[0] += sum(q)", LINE, "a loop that adds"),
    "NumPy": ("out[0] += np.sin(x)", LINE, "use math.sin"),
    "NumPy's arrays": ("out[0] += np.dot(q, v)", LINE, "write it on plain numbers"),
    "chance": ("out[0] += random.random()", LINE, "no chance but what it is given"),
    "a clock": ("out[0] += time.monotonic()", LINE, "a law knows no clock"),
    "a file": ("open('/tmp/x')", LINE, "no files"),
    "a global that another function changes": ("out[0] += count", LINE, "its state vector"),
    "a global that is a list": ("out[0] += TABLE[0]", LINE, "make it a tuple"),
    "an input written": ("q[0] = 0.0", LINE, "writes into q, which is only read"),
    "a list written into an output": ("out[0] = [x]", LINE, "writes a list into out[0]"),
    "a misspelt name": ("out[0] = xx", LINE, "NameError"),
    "arithmetic on vectors": ("out[0] = (q + v)[0]", LINE, "TypeError"),
    "an append": ("out.append(1.0)", LINE, "its length is fixed"),
}

REPLACED = {
    "an output that is never written": ("    out[1] = (a *", "    z = (a *", "never writes out[1]"),
    "an output added to": ("    out[1] = (a *", "    out[1] += (a *", "reads out[1] before it"),
    "too few arguments": (
        "response(c, q, v, effort, out)",
        "response(c, q, v, out)",
        "takes (coef",
    ),
    "too many arguments": ("v, effort, out)", "v, effort, t, out)", "has other arguments"),
    "no function": ("tuple, response)", "tuple, 'response')", "is a str, not a function"),
}

names = (f"own_arm_{number}" for number in itertools.count())


@pytest.fixture
def load(tmp_path, monkeypatch, capsys):
    """Load the arm's experiment, its module changed: ``load(old, new)``."""

    def changed(old="    # MISTAKE", new="", points=None, beside=False):
        for other in () if beside else tmp_path.glob("*.dist-info"):
            shutil.rmtree(other)
        registry.forget()
        notices.notice.cache_clear()
        name = next(names)
        assert ARM.count(old) >= 1
        module = ARM.replace(old, new, 1)
        points = points or {"plants": {"arm": "ARM"}, "models": {"arm": "MODEL"}}
        own_package.write(tmp_path, name, module, points)
        (tmp_path / "arm.yaml").write_text(FILE)
        return experiment.load(str(tmp_path / "arm.yaml"))

    monkeypatch.syspath_prepend(str(tmp_path))
    yield changed
    registry.forget()


def refused(load, *change):
    with pytest.raises(BadInput) as caught:
        load(*change)
    message = str(caught.value)
    assert "\n" not in message
    return message


def test_the_arm_itself_is_taken_with_its_unmarked_helper(load, capsys):
    assert load().loop().plant.coordinates == ("q1", "q2")
    assert capsys.readouterr().err == ""


@pytest.mark.parametrize("mistake", REFUSED)
def test_a_mistake_in_a_line_is_named_with_its_remedy(load, mistake):
    text, line, remedy = REFUSED[mistake]
    message = refused(load, "    # MISTAKE", f"    {text}")
    assert message.startswith("plant_simulator.plant arm: response (")
    assert f".py, line {line}) " in message
    assert remedy in message


@pytest.mark.parametrize("mistake", REPLACED)
def test_a_mistake_in_the_whole_is_named_with_its_remedy(load, mistake):
    old, new, remedy = REPLACED[mistake]
    message = refused(load, old, new)
    assert message.startswith("plant_simulator.plant arm: response")
    assert remedy in message


def test_a_mistake_in_a_helper_is_found_at_the_helpers_line(load):
    message = refused(load, "return GRAVITY * math.sin(q)", "return GRAVITY * np.sin(q)")
    line = ARM.splitlines().index("    return GRAVITY * math.sin(q)") + 1
    assert f"line {line}) calls np.sin" in message


def test_a_mistake_in_the_model_is_the_models(load):
    message = refused(load, "    out[1] = (mll + coupling) * r[0]", "    s[0] = r[0]")
    assert message.startswith("fpt_deformer.model arm: effort (")
    assert "writes into s" in message


def test_a_misspelt_entry_point(load):
    points = {"plants": {"arm": "ARMM"}, "models": {"arm": "MODEL"}}
    assert "ARMM" in refused(load, "    # MISTAKE", "", points)


def test_a_syntax_error_names_file_and_line(load):
    assert f"line {LINE}" in refused(load, "    # MISTAKE", "    out[0] = = 1")


def test_two_packages_with_one_name(load):
    load()
    with pytest.raises(BadInput, match="two packages register 'arm'"):
        load(beside=True)


def test_a_trial_call_changes_no_state(load):
    loop = load().loop()
    assert list(loop.plant.memory.position) == [0.0, 0.0]
    assert list(loop.plant.memory.velocity) == [0.0, 0.0]
    assert loop.deformer.memory.cycles[0] == 0.0


def test_a_change_of_a_helper_of_the_arms_is_not_missed_by_the_cache(load):
    first, second = (
        compiled._told_apart(load("GRAVITY = 9.81", f"GRAVITY = {g}").loop().plant.plant.response)
        for g in (9.81, 1.62)
    )
    assert first.__qualname__ != second.__qualname__


def test_a_print_is_told_of_and_stays_out_of_the_trial(load, capsys):
    load("    # MISTAKE", "    print(q[0])").loop()
    shown = capsys.readouterr()
    assert shown.out == ""
    assert shown.err.count("\n") == 1
    assert f"line {LINE}) prints, which makes" in shown.err


def test_a_law_that_cannot_be_compiled_runs_in_python_with_the_same_bits(load, capsys):
    plain = Engine(load().loop(), compile_laws=False)
    plain.run()
    slow = "    out[0] += 0.0 * float(len({'a': 'b'}.popitem()[1].encode('utf-16')) + 1)"
    loaded = load("    # MISTAKE", slow)
    engine = Engine(loaded.loop())
    engine.run()
    Engine(loaded.loop()).run()
    told = capsys.readouterr().err
    assert told.count("\n") == 1
    assert "a law cannot be compiled" in told
    assert f"line {LINE}: " in told
    assert engine_module.SLOWER in told
    for name, series in plain.topics().items():
        for vector, matrix in series.vectors.items():
            assert np.array_equal(matrix, engine.topics()[name].vectors[vector], equal_nan=True)


def test_the_command_line_ends_with_one_line_and_status_two(load, tmp_path):
    refused(load, "    # MISTAKE", "    out[2] = 0.0")
    done = own_package.fpt(tmp_path, "simulate", "arm.yaml")
    assert done.returncode == 2
    assert done.stderr.count("\n") == 1
    assert done.stderr.startswith("fpt: plant_simulator.plant arm: response (")


def test_the_command_line_runs_a_law_that_is_not_compiled(load, tmp_path):
    load("    # MISTAKE", "    out[0] += math.fmod(0.0, 1.0)")
    done = own_package.fpt(tmp_path, "simulate", "arm.yaml", "--json")
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout)["complete"]
    assert "Traceback" not in done.stderr
    assert done.stderr.count("cannot be compiled") == 1
