"""Laws in C, called by address: the same bits compiled, in Python, and in another process."""

import ctypes
import hashlib
import math
import shutil
import subprocess
from array import array

import numpy as np
import own_package
import pytest
from engine_runs import stage_by_stage
from frames_collected import Collector

from fpt_ros import foreign, registry
from fpt_ros.engine.engine import Engine
from fpt_ros.errors import BadInput
from fpt_ros.experiments import experiment

COMPILER = shutil.which("gcc") or shutil.which("cc")
pytestmark = pytest.mark.skipif(COMPILER is None, reason="there is no C compiler")

CYCLES = 300

C_SOURCE = """
#include <math.h>

void tora_response(const double *c, const double *q, const double *v, const double *effort,
                   double *out)
{
    double cosine = cos(q[0]), sine = sin(q[0]);
    double beam = c[1] - c[2], cart = c[3], coupling = c[0] * cosine;
    double torque = effort[0] - effort[1] + c[4] * sine;
    double force = effort[2] + c[0] * sine * v[0] * v[0];
    double determinant = beam * cart - coupling * coupling;
    out[0] = (torque * cart - coupling * force) / determinant;
    out[1] = effort[1] / c[2] - out[0];
    out[2] = (beam * force - coupling * torque) / determinant;
}

/* An arm with a drive that lags and saturates: it integrates itself. */
int arm_advance(void *gain, double *state, int joints, double dt, const double *effort,
                const double *external, double *q, double *v, double *acted)
{
    for (int i = 0; i < joints; i++) {
        state[i] += dt / 0.01 * (effort[i] - state[i]);
        acted[i] = fmax(-20.0, fmin(20.0, state[i]));
        v[i] += dt * (*(double *)gain * acted[i] + external[i] - 9.81 * sin(q[i]));
        q[i] += dt * v[i];
    }
    return joints;
}

double gain = 2.0;
double weighted(const double *x, long n, double factor) {
    double s = 0.0;
    for (long i = 0; i < n; i++) s += x[i];
    return factor * s;
}
int minus(int a) { return -a; }
void twice(double *x, int n) { for (int i = 0; i < n; i++) x[i] *= 2.0; }
void beyond(const double *c, double *out) { out[3] = 1.0; }
"""

MODULE = '''
"""Plants whose laws are in C; the file of the library is a parameter."""

import ctypes

from fpt_ros.foreign import address_of, call, call_int, pointer
from fpt_ros.parameters import Parameter, number, word
from fpt_ros.plants import Factory, Model, Plant, tora

LIBRARY = Parameter("library", "file of the C library", kind="str", live=False)


def response(c, q, v, effort, out):
    call(c[5], c, q, v, effort, out)


def beyond(c, q, v, effort, out):
    call(c[5], c, out)
    for i in range(3):
        out[i] = 0.0


def make_tora(values, name="tora_response", law=response):
    library = ctypes.CDLL(word(values, "library"))
    own = tora.coefficients([number(values, p.name) for p in tora.PARAMETERS])
    constants = (*own, address_of(getattr(library, name)))
    return Plant(tora.COORDINATES, ("rad", "rad", "m"), ("N m", "N m", "N"), (),
                 lambda parameters: constants, law)


TORA = Factory((LIBRARY, *tora.PARAMETERS), make_tora)
BEYOND = Factory((LIBRARY, *tora.PARAMETERS), lambda values: make_tora(values, "beyond", beyond))


def advance(c, state, t, dt, effort, external, q, v, acted):
    call_int(c[0], pointer(c[1]), state, len(q), dt, effort, external, q, v, acted)


def start(c, state, q, v):
    for i in range(2):
        state[i] = 0.25


def make_arm(values):
    library = ctypes.CDLL(word(values, "library"))
    constants = (
        address_of(library.arm_advance),
        float(ctypes.addressof(ctypes.c_double.in_dll(library, "gain"))),
    )
    return Plant(("q1", "q2"), ("rad", "rad"), ("N m", "N m"), (), lambda parameters: constants,
                 advance=advance, state=2, start=start)


ARM = Factory((LIBRARY,), make_arm)


def effort(c, q, v, r, s, out):
    for i in range(2):
        out[i] = c[0] * r[i]


MODEL = Model(("q1", "q2"), ("q1", "q2"), (Parameter("m", "inertia"),), ("m",), tuple, effort)
'''

ARM_FILE = """
/**/plant_simulator:
  ros__parameters: {{plant: c_arm, exact: {{library: "{library}"}}, dt: 0.001, duration: 0.3}}
/**/denoiser:
  ros__parameters: {{method: none}}
/**/trajectory_generator:
  ros__parameters: {{controlled: [q1, q2], trajectory: sine, amplitude: [0.8, 0.5],
    frequency: [3.0, 4.0], lambda: 6.0}}
/**/parameter_tuner:
  ros__parameters: {{method: none}}
/**/fpt_deformer:
  ros__parameters: {{transformation: none}}
/**/recorder:
  ros__parameters: {{title: an arm}}
/**:
  ros__parameters: {{model: c_arm, approximate: {{m: 0.6}}}}
"""

DIGEST = """
import hashlib
from fpt_ros.engine.engine import Engine
from fpt_ros.experiments import experiment
engine = Engine(experiment.load("arm.yaml").loop())
engine.run()
whole = hashlib.sha256()
for series in engine.topics().values():
    for vector in series.vectors.values():
        whole.update(vector.tobytes())
print(whole.hexdigest())
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """The library, and a package whose laws call it."""
    folder = tmp_path_factory.mktemp("in_c")
    (folder / "laws.c").write_text(C_SOURCE)
    options = ["-O2", "-ffp-contract=off", "-shared", "-fPIC"]
    libm = ["-o", folder / "liblaws.so", folder / "laws.c", "-lm"]
    subprocess.run([COMPILER, *options, *libm], check=True)
    plants = {"c_tora": "TORA", "c_beyond": "BEYOND", "c_arm": "ARM"}
    points = {"plants": plants, "models": {"c_arm": "MODEL"}}
    own_package.write(folder, "laws_in_c", MODULE, points)
    (folder / "arm.yaml").write_text(ARM_FILE.format(library=folder / "liblaws.so"))
    return folder


@pytest.fixture
def installed(folder, monkeypatch):
    monkeypatch.syspath_prepend(str(folder))
    registry.forget()
    yield folder
    registry.forget()


@pytest.fixture
def library(folder):
    return ctypes.CDLL(str(folder / "liblaws.so"))


def in_c(folder, plant):
    """TORA with its response in C."""
    file = f"plant_simulator.exact.library={folder / 'liblaws.so'}"
    duration = CYCLES * experiment.load("tora").nodes["plant_simulator"]["dt"]
    return experiment.load(
        "tora", settings=(f"plant_simulator.plant={plant}", file), duration=duration
    )


def topics(loop, compile_laws=True):
    engine = Engine(loop, compile_laws)
    engine.run()
    return engine.topics()


def in_stages(loop):
    collected = Collector()
    stage_by_stage(loop, collected)
    return collected.topics()


def assert_same(ours, theirs):
    assert ours.keys() == theirs.keys()
    for name, series in ours.items():
        for vector, matrix in series.vectors.items():
            assert matrix.tobytes() == theirs[name].vectors[vector].tobytes(), (name, vector)


VECTORS = {
    "list": lambda x: list(x),
    "array": lambda x: array("d", x),
    "memoryview": lambda x: memoryview(array("d", x)),
    "numpy": lambda x: np.array(x),
    "every second of an array": lambda x: np.repeat(np.array(x), 2)[::2],
    "single precision": lambda x: np.array(x, dtype=np.float32),
}


@pytest.mark.parametrize("kind", VECTORS)
def test_c_reads_and_writes_vectors_of_every_kind(library, kind):
    x = VECTORS[kind]([1.5, 2.0, -0.25])
    assert foreign.call_double(foreign.address_of(library.weighted), x, len(x), 2.0) == 6.5
    foreign.call(foreign.address_of(library.twice), x, 3)
    assert list(x) == [3.0, 4.0, -0.5]


def test_a_tuple_is_read_and_cannot_be_written(library):
    assert foreign.call_double(foreign.address_of(library.weighted), (1.0, 2.0), 2, 1.0) == 3.0
    with pytest.raises(TypeError):
        foreign.call(foreign.address_of(library.twice), (1.0, 2.0), 2)


def test_integers_keep_their_sign_and_no_address_is_refused(library):
    assert foreign.call_int(foreign.address_of(library.minus), 7) == -7
    for address in (0.0, -1.0, math.nan, 2.0**60):
        with pytest.raises(ValueError, match="not the address"):
            foreign.call(address, [1.0])
    with pytest.raises(TypeError, match="not a object"):
        foreign.call_int(foreign.address_of(library.minus), object())


def test_tora_in_c_gives_the_bits_of_tora(installed):
    built_in = topics(experiment.load("tora", duration=CYCLES * 0.001).loop())
    assert len(built_in["command"].stamps) == CYCLES
    loaded = in_c(installed, "c_tora")
    assert_same(topics(loaded.loop()), built_in)
    assert_same(topics(loaded.loop(), compile_laws=False), built_in)
    assert_same(in_stages(loaded.loop()), built_in)


def test_c_that_writes_beyond_its_vector_is_found_at_load(installed):
    with pytest.raises(BadInput, match=r"c_beyond: response .* beyond out, which has 3 numbers"):
        in_c(installed, "c_beyond")


def test_a_plant_that_integrates_itself_agrees_in_engine_stages_and_another_process(installed):
    loaded = experiment.load(str(installed / "arm.yaml"))
    compiled = topics(loaded.loop())
    assert_same(topics(loaded.loop(), compile_laws=False), compiled)
    assert_same(in_stages(loaded.loop()), compiled)
    whole = hashlib.sha256()
    for series in compiled.values():
        for vector in series.vectors.values():
            whole.update(vector.tobytes())
    assert own_package.python(installed, DIGEST).strip() == whole.hexdigest()


def test_the_effort_shown_is_what_acted(installed):
    shown = topics(experiment.load(str(installed / "arm.yaml")).loop())
    asked = shown["command"].vectors["effort"]
    acted = shown["joint_states"].vectors["effort"]
    lag = np.full(2, 0.25)
    for k in range(len(asked) - 1):
        lag += 0.001 / 0.01 * (asked[k] - lag)
        assert np.array_equal(acted[k + 1], np.clip(lag, -20.0, 20.0))
    assert (np.abs(asked) > 20.0).any()
