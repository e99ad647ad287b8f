"""Sections 4.1 and 4.2 behind other integrators: the thesis simulated them with XCOS's solvers."""

from fpt_ros.analysis.tables import number_text
from fpt_ros.runs.run import Run
from fpt_ros.thesis.claim import NO, ONLY_IF, YES, Claim, Table, Verdict
from fpt_ros.thesis.measures import chatter, settled_rms
from fpt_ros.thesis.setup import Runs, Setup

INTEGRATORS = ("explicit_euler", "semi_implicit_euler", "rk4", "dopri5")
EXPERIMENTS = {"swing": ("q1", "q2"), "kapitza": ("q2",)}
DURATION = 12.0


def _key(name: str, variant: str, kind: str) -> str:
    return f"{name}, {variant}, {kind}"


def _setup(name: str, variant: str, kind: str) -> Setup:
    return Setup(name, variant, (f"plant_simulator.integrator.kind={kind}",), DURATION)


def _holds(runs: Runs) -> Verdict:
    rows, gains, spread = [], {}, {}
    for name, joints in EXPERIMENTS.items():
        errors = {}
        for kind in INTEGRATORS:
            run, without = (runs[_key(name, v, kind)] for v in ("adaptive", "nonadaptive"))
            found = [settled_rms(run, joint) for joint in joints]
            before = [settled_rms(without, joint) for joint in joints]
            errors[kind] = max(found)
            gains[name, kind] = min(b / a for a, b in zip(found, before, strict=True))
            cells = (", ".join(map(number_text, x)) for x in (before, found))
            rows.append((f"{name}, {kind}", *cells, number_text(chatter(run))))
        spread[name] = errors["explicit_euler"] / errors["dopri5"]
    held = [gain > 2.0 for gain in gains.values()]
    return Verdict(
        YES if all(held) else ONLY_IF if any(held) else NO,
        {f"{name}: error, explicit Euler / dopri5": x for name, x in spread.items()},
        "With every integrator the adaptive controller is at least "
        f"{min(gains.values()):.3g} times as precise as the other; the plant's explicit Euler "
        "changes the settled error by the factors shown.",
        Table(
            ("experiment, integrator", "rms error, nonadaptive", "rms error, adaptive", "chatter"),
            tuple(rows),
        ),
    )


CLAIMS: tuple[Claim[Run], ...] = (
    Claim(
        "4.1",
        "",
        "The results of 4.1 and 4.2 do not hang on how the plant is integrated.",
        {
            _key(name, variant, kind): _setup(name, variant, kind)
            for name in EXPERIMENTS
            for variant in ("adaptive", "nonadaptive")
            for kind in INTEGRATORS
        },
        _holds,
    ),
)
