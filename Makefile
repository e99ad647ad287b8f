# make demo   the TORA experiment over DDS, recorded and reported
# make test   all tests; exhaustive ones (every cut, every variant over DDS) take a sample
# make test-all   the same without sampling
# make same-bits REV=...   compares the working tree with a commit, to the last bit
# make bench  all benchmarks (three quarters of an hour; the machine should be quiet)
# make docs   the documentation as a site, in site/
# make lock   requirements.lock anew after a change of setup.py (UPGRADE=1: with the newest versions)
# Each installs what it needs into .venv, in the versions of requirements.lock: ROS 2 Jazzy (from PyPI),
# this package and its extras (setup.py).

# A sourced ROS or another venv must not leak into ours.
unexport PYTHONPATH PYTHONHOME LD_LIBRARY_PATH AMENT_PREFIX_PATH COLCON_PREFIX_PATH
unexport VIRTUAL_ENV _ROS_WHEELS_BOOTSTRAP_COMPLETE RMW_IMPLEMENTATION
# uv installs without bytecode: it is written by the first import, where that is allowed
unexport PYTHONDONTWRITEBYTECODE

PYTHON ?= $(firstword $(foreach p,python3.12 python3.11 python3,$(shell $(p) -c 'import sys; sys.exit(not (3, 11) <= sys.version_info[:2] <= (3, 12))' 2>/dev/null && echo $(p))))
VENV := .venv
BIN := $(VENV)/bin
UV := $(or $(shell command -v uv),$(BIN)/uv)
LOCK := requirements.lock
DEMO := demo

# who installs with pip from a mirror installs with uv from the same
ifdef PIP_INDEX_URL
export UV_DEFAULT_INDEX ?= $(PIP_INDEX_URL)
endif

NEEDS_demo := ros,analysis
NEEDS_test := ros,test
NEEDS_lint := ros,test,lint
NEEDS_docs := ros,analysis,thesis,sweep,export,docs
NEEDS_bench := ros,test,bench
NEEDS_setup := ros,test,lint,docs

.PHONY: help setup demo test test-all same-bits bench lint docs lock clean

help:
	@echo "make demo | test | test-all | same-bits | bench | lint | docs | setup | lock | clean"

setup: $(VENV)/.setup

# .venv/.demo: what `make demo` needs is installed
$(VENV)/.%: setup.py setup.cfg pyproject.toml package.xml $(LOCK) | $(UV) $(BIN)/python
	@echo "installing what make $* needs into $(VENV) (half a minute the first time)"
	@rm -rf *.egg-info  # an older one would hide the entry points of this one
	@$(UV) pip install --quiet $(if $(filter setup,$*),--compile-bytecode) --python $(BIN)/python --constraint $(LOCK) --build-constraint $(LOCK) --editable '.[$(NEEDS_$*)]'
	@touch $@

# what Foxglove reads recordings with; without npm the tests of it are skipped
READERS := test/bags/node_reader
$(VENV)/.node: $(READERS)/package-lock.json | $(BIN)/python
	@if command -v npm >/dev/null; then npm ci --silent --prefix $(READERS) || echo "npm: $(READERS) is not installed"; fi
	@touch $@

$(BIN)/python:
	@test -n "$(PYTHON)" || { echo "fpt_ros needs Python 3.11 or 3.12: apt-get install python3"; exit 1; }
	@$(PYTHON) -c 'import venv, ensurepip' 2>/dev/null || { echo "Python's venv is missing: apt-get install python3-venv"; exit 1; }
	@$(PYTHON) -m venv $(VENV)

$(BIN)/uv: | $(BIN)/python
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check --constraint $(LOCK) uv

demo: $(VENV)/.demo
	@$(BIN)/fpt demo --out $(DEMO)

test: $(VENV)/.test $(VENV)/.node
	@$(BIN)/python -m pytest -n 3 --dist worksteal

test-all: $(VENV)/.test $(VENV)/.node
	@$(BIN)/python -m pytest -n 3 --dist worksteal --all

REV ?= HEAD
same-bits: $(VENV)/.test
	@$(BIN)/python test/same_bits $(REV) $(OPTIONS)

bench: $(VENV)/.bench
	@for each in engine robots long streaming sweep start graph realtime recorder watch recordings report; do $(BIN)/python benchmarks/$$each.py || exit 1; done

lint: $(VENV)/.lint
	@$(BIN)/ruff check .
	@$(BIN)/ruff format --check .
	@$(BIN)/mypy

docs: $(VENV)/.docs
	@$(BIN)/python -m sphinx -q -W --keep-going -n -b html docs site
	@echo "site/index.html"

lock: | $(UV)
	@$(UV) pip compile --quiet $(if $(UPGRADE),--upgrade) --all-extras --universal --python-version 3.11 \
		--no-header --no-annotate --no-emit-index-url --output-file $(LOCK) setup.py

clean:
	rm -rf $(VENV) build install log site $(DEMO) *.egg-info
