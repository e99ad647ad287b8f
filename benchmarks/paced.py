"""Runs the engine of one tree and tells how long each run took [s]; started by ``before.py``.

A line of the standard input is a run: EXPERIMENT CYCLES compiled|python. The tree may be of any
age: ``test/same_bits/dumper.py`` knows what its modules are called.
"""

import sys
from pathlib import Path
from time import perf_counter

sys.path.insert(0, str(Path(__file__).parents[1] / "test" / "same_bits"))
from dumper import ENGINE, EXPERIMENT, module


def seconds(name: str, cycles: int, compiled: bool) -> float:
    """What the run took, its preparation not counted."""
    experiment = module(EXPERIMENT).load(name)
    dt = experiment.loop().plant.dt
    loop = experiment.with_values("plant_simulator", duration=cycles * dt).loop()
    engine = module(ENGINE).Engine(loop, compile_laws=compiled)
    started = perf_counter()
    engine.run()
    return perf_counter() - started


try:
    for line in sys.stdin:
        experiment, length, how = line.split()
        print(seconds(experiment, int(length), how == "compiled"), flush=True)
except KeyboardInterrupt:
    sys.exit(130)
except Exception as error:
    sys.exit(f"{type(error).__name__}: {error}")
