"""The package of docs/extending.md, as the page has it: installed, simulated, run as a graph."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from command import BIN

PAGE = Path(__file__).parents[1] / "docs" / "extending.md"
FILE = re.compile(r"^`([\w.]+)`\n\n```\w*\n(.*?)^```$", re.MULTILINE | re.DOTALL)


@pytest.fixture(scope="module")
def package(tmp_path_factory):
    """Folder with the page's files; the package is installed below it."""
    folder = tmp_path_factory.mktemp("my_fpt")
    files = dict(FILE.findall(PAGE.read_text(encoding="utf-8")))
    assert set(files) == {"pyproject.toml", "my_fpt.py", "pendulum.yaml"}
    for name, text in files.items():
        (folder / name).write_text(text, encoding="utf-8")
    pip = [sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--no-build-isolation"]
    subprocess.run([*pip, "--target", folder / "site", folder], check=True, timeout=120)
    return folder


def fpt(package, *arguments):
    environment = {**os.environ, "PYTHONPATH": str(package / "site")}
    done = subprocess.run(
        [BIN / "fpt", *map(str, arguments), "--json"],
        capture_output=True,
        text=True,
        timeout=120,
        env=environment,
        cwd=package,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_page_shows_the_laws_in_forty_lines():
    files = dict(FILE.findall(PAGE.read_text(encoding="utf-8")))
    code = [line for line in files["my_fpt.py"].splitlines() if line.strip()]
    assert len(code) <= 40


def test_a_package_of_its_own_adds_plant_transformation_and_tuning_law(package):
    settings = ("--set", "parameter_tuner.method=none", "--set", "fpt_deformer.transformation=none")
    plain = fpt(package, "simulate", "pendulum.yaml", *settings)
    ours = fpt(package, "simulate", "pendulum.yaml")
    assert plain["complete"]
    assert ours["complete"]
    error, before = (x["tracking"]["q1"]["rms_settled"] for x in (ours, plain))
    assert error < 0.1 * before
    assert ours["final_parameters"]["ml2"] != 0.25


def test_the_graph_runs_it_with_the_same_numbers(package):
    engine = fpt(package, "simulate", "pendulum.yaml", "--duration", 1)
    graph = fpt(package, "run", "pendulum.yaml", "--duration", 1, "--composed")
    assert graph["tracking"] == engine["tracking"]
    assert graph["chatter"] == engine["chatter"]
