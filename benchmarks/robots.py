"""An arm in process against a plain script on MuJoCo's and Pinocchio's Python bindings.

Both simulate ``panda``: a plant with 2 kg, a model of half the inertia, SGFPT. Their settled errors
are compared before anything is timed. Beside them the work of the deformer's node in a cycle: two
messages decoded, its step, one encoded. All in processor time of one thread, so that other load on
the machine counts little.
"""

import math
from collections.abc import Callable
from pathlib import Path
from time import thread_time

import mujoco
import numpy as np
import pinocchio as pin
from measure import alternate, arguments, median, show

from fpt_ros.cycle.run import Run
from fpt_ros.engine.engine import Engine
from fpt_ros.experiments.experiment import Experiment, load
from fpt_ros.messages.cdr import Codec
from fpt_ros.messages.topics import COMMAND, DESIRED, STATE_ESTIMATE
from fpt_ros.plants.mujoco.description_file import ARMS

AGREEMENT = 0.01
DT, RISE, LAMBDA = 1e-3, 2.0, 15.0
A, K, D, S = -3.16, 0.5, 0.6, 10.0


def with_duration(cycles: int) -> Experiment:
    """The experiment for so many cycles."""
    return load("panda").with_values("plant_simulator", duration=cycles * DT)


def engine_pace(cycles: int) -> float:
    """Cycles a second of the compiled engine."""
    engine = Engine(with_duration(cycles).loop(), consumers=())
    started = thread_time()
    engine.run()
    return cycles / (thread_time() - started)


class Script:
    """The loop as one writes it on the two libraries."""

    def __init__(self) -> None:
        path = Path(ARMS / "panda.xml")
        spec = mujoco.MjSpec.from_file(str(path))
        tool = spec.site("flange").parent.add_body(name="tool", pos=spec.site("flange").pos)
        tool.mass, tool.inertia, tool.ipos = 2.0, [0.004] * 3, [0.0, 0.0, 0.05]
        tool.explicitinertial = True
        self.model = spec.compile()
        self.model.opt.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
        self.arm = pin.buildModelFromMJCF(path)
        for inertia in self.arm.inertias:
            inertia.mass *= 0.5
            inertia.inertia *= 0.5
        self.arm.armature *= 0.5
        self.rnea = self.arm.createData()
        given = load("panda").nodes["trajectory_generator"]
        names = ("offset", "amplitude", "frequency", "phase")
        seconds = ("second_amplitude", "second_frequency", "second_phase")
        self.motion = [np.array(given[name]) for name in (*names, *seconds)]
        self.limits = np.array([87.0] * 4 + [12.0] * 3)
        half = 0.5 * math.acosh(2.0 * math.sinh(D) / K - math.cosh(D))
        self.attractive, self.repulsive = 0.5 * D + half, 0.5 * D - half

    def nominal(self, t: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Position, velocity, acceleration."""
        offset, a, w, p, b, u, o = self.motion
        x = min(t / RISE, 1.0)
        s = x * x * x * (10.0 + x * (6.0 * x - 15.0))
        s_v = 30.0 * x * x * (1.0 - x) * (1.0 - x) / RISE
        s_a = 60.0 * x * (1.0 - x) * (1.0 - 2.0 * x) / (RISE * RISE)
        sin, cos = np.sin(w * t + p), np.cos(w * t + p)
        sin_2, cos_2 = np.sin(u * t + o), np.cos(u * t + o)
        y, y_v = a * sin + b * sin_2, a * w * cos + b * u * cos_2
        y_a = -a * w * w * sin - b * u * u * sin_2
        return offset + s * y, s_v * y + s * y_v, s_a * y + 2.0 * s_v * y_v + s * y_a

    def run(self, cycles: int) -> tuple[float, float]:
        """Cycles a second, and the settled rms error over all joints [rad]."""
        data = mujoco.MjData(self.model)
        data.qpos[:] = self.motion[0]
        r, before, total, settled = None, None, 0.0, 0
        started = thread_time()
        for k in range(cycles):
            q, v = data.qpos.copy(), data.qvel.copy()
            q_n, v_n, a_n = self.nominal(k * DT)
            error = q_n - q
            desired = a_n + LAMBDA * LAMBDA * error + 2.0 * LAMBDA * (v_n - v)
            if r is None:
                r = desired
            else:
                h = (v - before) / DT - desired
                size = math.sqrt(h @ h)
                x = max(A * size / S + self.attractive, self.repulsive)
                step = S * (math.atanh(math.tanh(x) - K) + D - self.attractive)
                r = r + step / size * h
            before = v
            effort = pin.rnea(self.arm, self.rnea, q, v, r)
            data.qfrc_applied[:] = np.clip(effort, -self.limits, self.limits)
            mujoco.mj_step(self.model, data)
            if k * DT >= 2.5:
                total += error @ error
                settled += len(error)
        took = thread_time() - started
        return cycles / took, math.sqrt(total / settled) if settled else math.nan


def check(cycles: int) -> float:
    """Relative difference of the settled errors.

    Raises:
        RuntimeError: they do not agree.
    """
    engine = Engine(with_duration(cycles).loop())
    engine.run()
    topics = engine.topics()
    nominal = topics["desired"].vectors["positions"]
    error = (nominal - topics["joint_states"].vectors["position"])[2500:]
    ours, theirs = float(np.sqrt(np.mean(error**2))), Script().run(cycles)[1]
    difference = abs(ours - theirs) / ours
    if not difference <= AGREEMENT:
        raise RuntimeError(f"settled errors differ: engine {ours:.4g}, script {theirs:.4g} rad")
    return difference


def deformer_node(cycles: int) -> Callable[[], float]:
    """Measures the microseconds of the deformer's node in a cycle: decode, step, encode."""
    loop = with_duration(cycles).loop()
    kept: dict[str, list[bytes]] = {STATE_ESTIMATE.name: [], DESIRED.name: []}
    codecs = {topic.name: Codec(topic) for topic in (STATE_ESTIMATE, DESIRED, COMMAND)}
    for topic, frame in Run(loop).frames():
        if topic.name in kept:
            kept[topic.name].append(codecs[topic.name].encode(frame))

    def measure() -> float:
        deformer = with_duration(cycles).loop().deformer
        estimate, desired, command = codecs.values()
        started = thread_time()
        for shown, wanted in zip(*kept.values(), strict=True):
            command.encode(deformer.step(estimate.decode(shown), desired.decode(wanted)))
        return (thread_time() - started) / cycles * 1e6

    return measure


def main() -> None:
    """Measure and print."""
    given = arguments(__doc__ or "", cycles=50_000)
    difference = check(6500)
    engine_pace(2000)  # compiles
    few = given.cycles // 10
    found = median(
        alternate(
            {
                "engine, compiled": lambda: engine_pace(given.cycles),
                "script on mujoco and pin": lambda: Script().run(few)[0],
                "deformer's node": deformer_node(2000),
            },
            given.runs,
            given.json,
        )
    )
    script = found["script on mujoco and pin"]
    rows = [
        {"panda": name, "cycles/s": found[name], "x script": found[name] / script}
        for name in ("engine, compiled", "script on mujoco and pin")
    ]
    rows.append({"panda": "deformer's node, us a cycle", "cycles/s": found["deformer's node"]})
    for row in rows:
        row.setdefault("x script", None)
    show(f"An arm (settled errors agree within {difference:.1g})", rows, given.json)


if __name__ == "__main__":
    main()
