import json

import pytest
from engine_runs import chatter, settled_rms, topics_of

from fpt_ros.errors import BadInput
from fpt_ros.experiments.experiment import load
from fpt_ros.sweep import job as jobs
from fpt_ros.sweep.definition import define
from fpt_ros.sweep.executor import keep_memory
from fpt_ros.sweep.point_experiments import experiments_of
from fpt_ros.sweep.run_one import run_chunk


def job_of(name, grids, variant="adaptive", settings=(), duration=None, **options):
    options = {"random": None, "seed": 0, "metrics": (), **options}
    return define(name, variant, settings, duration, grids, **options).job


def rows_of(job):
    _, rows = run_chunk(job, range(job.space.size))
    return [dict(zip(job.columns, row, strict=True)) for row in rows]


CASES = [
    # numbers of one node, and of the section that nodes share
    ("tora", "adaptive", ["fpt_deformer.A=-0.1:-4.5:3", "fpt_deformer.approximate.m=8:12:2"]),
    # words change which parameters there are
    (
        "tora",
        "adaptive",
        ["fpt_deformer.transformation=none,sgfpt", "trajectory_generator.lambda=5,6"],
    ),
    ("tora", "adaptive", ["plant_simulator.initial_position[0]=-0.1:0.1:3"]),
    ("vdp_rfpt", "adaptive", ["plant_simulator.dt=0.001,0.002"]),
    ("noisy_tora", "adaptive", ["plant_simulator.seed=1:3:3"]),
]


@pytest.mark.parametrize(("name", "variant", "grids"), CASES, ids=lambda c: str(c)[:40])
def test_parameters_are_those_of_the_loader(name, variant, grids):
    """The short way of a sweep gives, node by node, what ``fpt simulate --set`` would run."""
    job = job_of(name, grids, variant, duration=1.0)
    for number in range(job.space.size):
        point = job.space.point(number)
        experiment, _ = experiments_of(job).at(point)
        assert experiment.nodes == load(name, variant, job.options(point), 1.0).nodes


def test_the_short_way_is_taken(monkeypatch):
    job = job_of("tora", ["fpt_deformer.A=-0.1:-2:9"], duration=0.1)
    run_chunk(job, [0])
    monkeypatch.setattr(jobs, "load", lambda *given: pytest.fail("files are read again"))
    (row,) = run_chunk(job, [5])[1]
    assert row[-1] is not None


def test_equal_jobs_of_other_types_are_told_apart():
    """1, 1.0 and True are equal for Python, and -0.0 is 0.0."""
    for values in ("1,2", "1.0,2.0", "1,2"):
        (row,) = run_chunk(job_of("tora", [f"fpt_deformer.D={values}"], duration=0.1), [0])[1]
        assert repr(row[1]) == values.split(",")[0]


def test_a_process_keeps_its_memory_and_its_numbers():
    job = job_of("tora", ["fpt_deformer.A=-0.1:-2:9"], duration=1.0)
    before = run_chunk(job, [3, 4])[1]
    keep_memory()
    assert run_chunk(job, [3, 4])[1] == before


def test_numbers_are_those_of_a_run_worked_out_independently():
    job = job_of("tora", ["fpt_deformer.A=-0.2,-3"], duration=6.0)
    for row in rows_of(job):
        topics = topics_of(
            "tora", settings=[f"fpt_deformer.A={row['fpt_deformer.A']}"], duration=6.0
        )
        for name, value in settled_rms(topics, 4.0).items():
            assert row[f"rms_settled.{name}"] == pytest.approx(value, rel=1e-12)
        assert row["chatter"] == pytest.approx(chatter(topics), rel=1e-12)


def test_runs_that_diverge_or_are_not_valid_are_rows():
    job = job_of("tora", ["fpt_deformer.A=-0.1,1", "fpt_deformer.K=0.5,1.99"], duration=2.0)
    rows = rows_of(job)
    assert [row["outcome"] for row in rows] == ["complete", "invalid", "diverged", "invalid"]
    lost = rows[2]
    assert lost["reason"].startswith(f"diverged at t = {lost['diverged_at']:.6g} s")
    assert lost["cycles"] == round(lost["diverged_at"] / 0.001) + 1  # from cycle 0 on
    assert "no fixed point" in rows[1]["reason"]
    assert json.loads(json.dumps(rows, allow_nan=False)) == rows


def test_metrics_by_name_and_by_kind():
    job = job_of("tora", ["fpt_deformer.A=-1,-2"], metrics=["rms_settled", "effort.q1", "chatter"])
    assert job.metrics == ("rms_settled.q3", "rms_settled.q2", "effort.q1", "chatter")
    with pytest.raises(BadInput, match=r"there is no metric 'noise': there are rms_settled\.q3, "):
        job_of("tora", ["fpt_deformer.A=-1,-2"], metrics=["noise"])
