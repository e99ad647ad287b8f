"""The in-process engine against the same loop in C, NumPy, solve_ivp and python-control.

The C loops (``c/*.c``) are compiled here with the system's compiler, -O2. Before anything is timed,
their settled errors are compared with the engine's. NumPy, solve_ivp and python-control run TORA.
"""

import ctypes
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from time import perf_counter
from typing import Any

import numpy as np
from measure import alternate, arguments, median, show

from fpt_ros.analysis.sizes import rms
from fpt_ros.engine.engine import Engine
from fpt_ros.experiments.experiment import load

EXPERIMENTS = ("tora", "vdp_rfpt", "cart_beam_hamper", "spherical_pendulum")
AGREEMENT = 1e-9
SOURCES = Path(__file__).parent / "c"


def engine_of(name: str, cycles: int | None = None, keep: bool = True) -> Engine:
    """A fresh engine, for the experiment's own duration or for so many cycles."""
    experiment = load(name)
    if cycles is not None:
        dt = experiment.loop().plant.dt
        experiment = experiment.with_values("plant_simulator", duration=cycles * dt)
    return Engine(experiment.loop(), consumers=None if keep else ())


def c_loop(name: str, folder: Path, *flags: str) -> Callable[..., int]:
    """The compiled C loop."""
    compiler = shutil.which("cc") or sys.exit("benchmarks/engine.py needs a C compiler (cc)")
    library = folder / f"{name}{''.join(flags)}.so"
    source = SOURCES / f"{name}.c"
    command = [compiler, "-O2", *flags, "-shared", "-fPIC", str(source), "-o", str(library), "-lm"]
    subprocess.run(command, check=True)
    run = ctypes.CDLL(str(library)).run
    run.restype = ctypes.c_long
    run.argtypes = [ctypes.c_long, ctypes.POINTER(ctypes.c_void_p)]
    return run


def rows_like(engine: Engine, cycles: int) -> list[np.ndarray]:
    """Fresh memory of the shape of the engine's messages."""
    rows = [m for vectors in engine._buffers._arrays.values() for m in vectors]
    return [np.empty((cycles, m.shape[1])) for m in rows]


def rows_of(engine: Engine) -> list[np.ndarray]:
    """The engine's messages in the order of the C loop, which has rows for a tuner in any case."""
    topics = engine.topics()
    kept = [m for name in topics for m in topics[name].vectors.values()]
    return kept if "tuning" in topics else [*kept[:11], np.empty((len(kept[0]), 0)), *kept[11:]]


def run_c(run: Callable[..., int], rows: list[np.ndarray], cycles: int | None = None) -> float:
    """Cycles a second; of a loop that keeps nothing ``rows`` may be shorter than ``cycles``."""
    pointers = (ctypes.c_void_p * len(rows))(*[row.ctypes.data for row in rows])
    cycles = len(rows[0]) if cycles is None else cycles
    started = perf_counter()
    reached = run(cycles, pointers)
    took = perf_counter() - started
    if reached != cycles:
        raise RuntimeError(f"the C loop ended in cycle {reached}")
    return cycles / took


def check(name: str, run: Callable[..., int], cycles: int) -> float:
    """Largest relative difference of the settled rms errors of engine and C.

    Raises:
        RuntimeError: they do not agree.
    """
    engine = engine_of(name, cycles)
    engine.run()
    rows = rows_like(engine, engine.cycles)
    run_c(run, rows)
    own = rows_of(engine)
    where = engine._loop.trajectory.locate(engine._loop.plant.coordinates)
    experiment = load(name)
    first = round(float(experiment.about["settle_time"]) / engine._loop.plant.dt)
    worst = 0.0
    for i, at in enumerate(where):
        a, b = (rms((m[7][:, i] - m[0][:, at])[first:]) or 0.0 for m in (own, rows))
        worst = max(worst, abs(a - b) / a)
    if not worst <= AGREEMENT:
        raise RuntimeError(f"{name}: settled errors of engine and C differ by {worst:.2g}")
    return worst


class NumpyTora:
    """The TORA loop on small arrays, as one writes it in NumPy; its state is one vector."""

    def __init__(self) -> None:
        from scipy.interpolate import CubicSpline

        knots = [0.0, 0.7, 1.0, 0.7, 0.0, -0.7, -1.0, -0.7, 0.0]
        spline = CubicSpline(0.5 * np.arange(9), knots, bc_type="periodic")
        self.nominal = [spline, spline.derivative(), spline.derivative(2)]
        self.scale = np.array([0.3, 0.5])
        self.where = np.array([2, 1])
        self.exact, self.model = (40.0, 100.0, 20.0, 50.0, 392.4), (20.0, 45.0, 5.0, 30.0, 196.2)
        half = 0.5 * np.arccosh(2 * np.sinh(0.6) / 0.5 - np.cosh(0.6))
        self.attractive, self.repulsive = 0.3 + half, 0.3 - half
        self.dt = 0.001

    def start(self) -> np.ndarray:
        """q, v, v before, r before, integral of e, e before."""
        return np.array([0.0] * 9 + [np.nan] * 2 + [0.0] * 4)

    def control(self, t: float, x: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Effort, deformed response, and the integrals and errors to be kept."""
        q, v, before, r = x[:3], x[3:6], x[6:9], x[9:11]
        qN, vN, aN = (self.scale * spline(t) for spline in self.nominal)
        e, e_dot = qN - q[self.where], vN - v[self.where]
        integral = x[11:13] + self.dt * x[13:15]
        desired = aN + 108.0 * e + 18.0 * e_dot + 216.0 * integral
        if np.isnan(r[0]):
            r = desired
        else:
            h = ((v - before) / self.dt)[self.where] - desired
            size = np.linalg.norm(h)
            if size > 1e-12:
                y = max(-0.1 * size + self.attractive, self.repulsive)
                r = r + (np.arctanh(np.tanh(y) - 0.5) + 0.6 - self.attractive) * h / size
        c, cos, sin = self.model, np.cos(q[0]), np.sin(q[0])
        coupling, turn = c[0] * cos, sin / cos * v[0] * v[0]
        beam = (coupling - c[1] * c[3] / coupling) * r[0] + c[2] * r[1] + c[1] * turn - c[4] * sin
        effort = np.array([beam, c[2] * (r[1] - c[3] / coupling * r[0] + turn), 0.0])
        return effort, r, np.concatenate([integral, e])

    def response(self, q: np.ndarray, v: np.ndarray, effort: np.ndarray) -> np.ndarray:
        """Acceleration of the exact plant."""
        c, cos, sin = self.exact, np.cos(q[0]), np.sin(q[0])
        H = np.array([[c[1], c[2], c[0] * cos], [c[2], c[2], 0.0], [c[0] * cos, 0.0, c[3]]])
        rest = np.array([-c[4] * sin, 0.0, -c[0] * sin * v[0] * v[0]])
        return np.linalg.solve(H, effort - rest)

    def step(self, t: float, x: np.ndarray) -> np.ndarray:
        """One cycle, the plant by explicit Euler."""
        effort, r, kept = self.control(t, x)
        q, v = x[:3], x[3:6]
        a = self.response(q, v, effort)
        return np.concatenate([q + self.dt * v, v + self.dt * a, v, r, kept])

    def step_ivp(self, t: float, x: np.ndarray) -> np.ndarray:
        """One cycle, the plant by scipy's solve_ivp with the effort held."""
        from scipy.integrate import solve_ivp

        effort, r, kept = self.control(t, x)

        def rate(_: float, z: np.ndarray) -> np.ndarray:
            return np.concatenate([z[3:], self.response(z[:3], z[3:], effort)])

        found = solve_ivp(rate, (0.0, self.dt), x[:6])
        return np.concatenate([found.y[:, -1], x[3:6], r, kept])


def pace_of(step: Callable[[float, np.ndarray], np.ndarray], cycles: int) -> float:
    """Cycles a second of a Python loop over a step; all states are kept."""
    x = NumpyTora().start()
    kept = np.empty((cycles, len(x)))
    started = perf_counter()
    for k in range(cycles):
        kept[k] = x
        x = step(k * 0.001, x)
    return cycles / (perf_counter() - started)


def pace_of_control(cycles: int) -> float:
    """Cycles a second of python-control: the closed loop as one system in discrete time."""
    import control

    loop = NumpyTora()

    def update(t: float, x: np.ndarray, u: np.ndarray, params: Any) -> np.ndarray:
        return loop.step(t, x)

    system = control.nlsys(update, None, inputs=1, states=15, dt=loop.dt)
    times = loop.dt * np.arange(cycles)
    started = perf_counter()
    control.input_output_response(system, times, np.zeros(cycles), loop.start())
    return cycles / (perf_counter() - started)


def pace_of_python(cycles: int) -> float:
    """Cycles a second of the engine without machine code."""
    loop = load("tora").with_values("plant_simulator", duration=cycles * 0.001).loop()
    engine = Engine(loop, compile_laws=False)
    started = perf_counter()
    engine.run()
    return cycles / (perf_counter() - started)


def in_python(cycles: int) -> dict[str, Callable[[], float]]:
    """TORA without machine code; these are slow, so that fewer cycles do."""
    loop = NumpyTora()
    return {
        "tora: engine, in Python": lambda: pace_of_python(4 * cycles),
        "tora: NumPy": lambda: pace_of(loop.step, cycles),
        "tora: solve_ivp a cycle": lambda: pace_of(loop.step_ivp, cycles // 4),
        "tora: python-control": lambda: pace_of_control(cycles),
    }


def main() -> None:
    """Check, measure, and print the table."""
    options = arguments(__doc__ or "", cycles=1_000_000, only="")
    rows = []
    with tempfile.TemporaryDirectory(prefix="fpt-bench-") as folder:
        for name in (options.only,) if options.only else EXPERIMENTS:
            run = c_loop(name, Path(folder))
            worst = check(name, run, options.cycles)

            def engine(name: str = name) -> float:
                one = engine_of(name, options.cycles)
                started = perf_counter()
                one.run()
                return one.cycles / (perf_counter() - started)

            def in_c(name: str = name, run: Callable[..., int] = run) -> float:
                return run_c(run, rows_like(engine_of(name, 1), options.cycles))

            measurements = {f"{name}: C, -O2": in_c, f"{name}: engine": engine}
            if name == "tora":
                measurements |= in_python(max(options.cycles // 200, 100))
            found = median(alternate(measurements, options.runs, options.json))
            base = found[f"{name}: C, -O2"]
            rows += [
                {
                    "what": what,
                    "cycles/s": rate,
                    "ratio to C": rate / base,
                    "settled errors differ from C by": f"{worst:.1e}" if "engine" in what else None,
                }
                for what, rate in found.items()
            ]
    show(f"Engine, {options.cycles:,} cycles", rows, options.json)


if __name__ == "__main__":
    main()
