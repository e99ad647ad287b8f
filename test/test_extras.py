"""What works without the packages of the extras, and what a command says whose extra is missing."""

import re
import runpy
from importlib.metadata import packages_distributions
from pathlib import Path

import pytest
import setuptools
from blocked import python_without

from fpt_ros.extras import MODULES

ROOT = Path(__file__).parents[1]
OPTIONAL = {module for modules in MODULES.values() for module in modules}
FPT = ("-m", "fpt_ros.cli.main")

IMPORT_NODES = """
import importlib, pkgutil, fpt_ros.nodes as nodes
for module in pkgutil.walk_packages(nodes.__path__, "fpt_ros.nodes."):
    importlib.import_module(module.name)
    print(module.name)
"""


def names(requirements):
    """Distributions of requirements, as the lock spells them."""
    bare = (re.split(r"[\[<>=;]", each)[0].lower() for each in requirements)
    return {re.sub(r"[-_.]+", "-", each) for each in bare}


@pytest.fixture(scope="module")
def given():
    """The arguments of setup() in setup.py."""
    found = {}
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(ROOT)
        patch.setattr(setuptools, "setup", lambda **arguments: found.update(arguments))
        runpy.run_path("setup.py")
    return found


def test_every_node_module_is_imported_without_the_extras(tmp_path):
    done = python_without(OPTIONAL, tmp_path, "-c", IMPORT_NODES)
    assert done.returncode == 0, done.stderr
    files = {path.stem for path in (ROOT / "fpt_ros" / "nodes").glob("[!_]*.py")}
    assert {line.rpartition(".")[2] for line in done.stdout.split()} == files


@pytest.mark.parametrize("experiment", ["tora", "noisy_tora"])
def test_simulate_runs_and_records_without_the_extras(tmp_path, experiment):
    bag = tmp_path / "bag"
    arguments = ("simulate", experiment, "--duration", "0.1", "--record", bag)
    done = python_without(OPTIONAL, tmp_path, *FPT, *arguments)
    assert done.returncode == 0, done.stderr
    shown = python_without(OPTIONAL, tmp_path, *FPT, "info", bag)
    assert shown.returncode == 0, shown.stderr


@pytest.mark.parametrize(
    ("extra", "module", "arguments"),
    [
        ("analysis", "jinja2", ("report", "nothing")),
        ("analysis", "matplotlib", ("demo",)),
        ("analysis", "bokeh", ("report", "nothing")),
        ("analysis", "matplotlib", ("gain", "tora", "--plot", "gain.png")),
        ("sweep", "pyarrow", ("sweep", "tora", "--grid", "fpt_deformer.A=-1:-2:2")),
        ("sweep", "optuna", ("tune", "tora", "--over", "fpt_deformer.A")),
        ("denoise", "pyarrow", ("denoise", "test:sines")),
        ("thesis", "jinja2", ("reproduce",)),
        (
            "cluster",
            "distributed",
            (
                "sweep",
                "tora",
                "--grid",
                "fpt_deformer.A=-1:-2:2",
                "--scheduler",
                "tcp://127.0.0.1:1",
            ),
        ),
        ("peers", "skimage", ("denoise", "test:sines", "--method", "bayesshrink")),
    ],
)
def test_a_missing_extra_is_one_line_before_anything_is_done(tmp_path, extra, module, arguments):
    done = python_without({module}, tmp_path, *FPT, *arguments)
    assert done.returncode == 2, done.stderr
    assert done.stderr == f"fpt: {module} is not installed: pip install 'fpt_ros[{extra}]'\n"
    left = {path.name for path in tmp_path.iterdir()}
    assert left <= {"sitecustomize.py", "__pycache__"}


def test_the_extras_named_in_messages_bring_the_modules(given):
    distributions = packages_distributions()
    for extra, modules in MODULES.items():
        brought = names(given["extras_require"][extra])
        for module in modules:
            assert names(distributions[module]) & brought, (extra, module)


def test_the_lock_has_a_version_of_every_package_and_names_no_place(given):
    text = (ROOT / "requirements.lock").read_text()
    locked = set(re.findall(r"^([a-z0-9-]+)==\S+", text, re.MULTILINE))
    assert len(re.findall(r"^[^#\s]", text, re.MULTILINE)) == len(
        re.findall(r"^[a-z0-9-]+==[\w.+!]+( ; .*)?$", text, re.MULTILINE)
    )
    wanted = names(given["install_requires"]).union(*map(names, given["extras_require"].values()))
    assert wanted - locked == set()
    assert not re.search(r"://|@|file:|/", text)


def test_the_version_is_that_of_package_xml(given, tmp_path):
    version = re.search("<version>(.*)</version>", (ROOT / "package.xml").read_text())[1]
    assert given["version"] == version
    assert python_without((), tmp_path, *FPT, "--version").stdout == f"{version}\n"
