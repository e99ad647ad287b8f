# make demo   the TORA experiment over DDS, recorded and reported
# make test   all tests; exhaustive ones (every cut, every variant over DDS) take a sample
# make test-all   the same without sampling
# make same-bits REV=...   compares the working tree with a commit, to the last bit
# make bench  all benchmarks (three quarters of an hour; the machine should be quiet)
# All set up what is missing: a .venv with ROS 2 Jazzy (from PyPI) and this package in it.

# A sourced ROS or another venv must not leak into ours.
unexport PYTHONPATH PYTHONHOME LD_LIBRARY_PATH AMENT_PREFIX_PATH COLCON_PREFIX_PATH
unexport VIRTUAL_ENV _ROS_WHEELS_BOOTSTRAP_COMPLETE RMW_IMPLEMENTATION

PYTHON ?= $(firstword $(foreach p,python3.12 python3.11 python3,$(shell $(p) -c 'import sys; sys.exit(not (3, 11) <= sys.version_info[:2] <= (3, 12))' 2>/dev/null && echo $(p))))
VENV := .venv
BIN := $(VENV)/bin
READY := $(VENV)/.ready
DEMO := demo

.PHONY: help setup demo test test-all same-bits bench lint clean

help:
	@echo "make demo | test | test-all | same-bits | bench | lint | setup | clean"

setup: $(READY)

$(READY): setup.py setup.cfg pyproject.toml requirements-ros.txt requirements-dev.txt
	@test -n "$(PYTHON)" || { echo "fpt_ros needs Python 3.11 or 3.12: apt-get install python3"; exit 1; }
	@$(PYTHON) -c 'import venv, ensurepip' 2>/dev/null || { echo "Python's venv is missing: apt-get install python3-venv"; exit 1; }
	@test -x $(BIN)/python || $(PYTHON) -m venv $(VENV)
	@echo "installing ROS 2 Jazzy and fpt_ros into $(VENV) (about a minute)"
	@rm -rf *.egg-info  # an older one would hide the entry points of this one
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check -r requirements-ros.txt -r requirements-dev.txt -e .
	@touch $@

demo: $(READY)
	@$(BIN)/fpt demo --out $(DEMO)

test: $(READY)
	@$(BIN)/python -m pytest -n 2 --dist worksteal

test-all: $(READY)
	@$(BIN)/python -m pytest -n 2 --dist worksteal --all

REV ?= HEAD
same-bits: $(READY)
	@$(BIN)/python test/same_bits $(REV) $(OPTIONS)

bench: $(READY)
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check -r requirements-bench.txt
	@for each in engine streaming sweep start graph realtime; do $(BIN)/python benchmarks/$$each.py || exit 1; done

lint: $(READY)
	@$(BIN)/ruff check .
	@$(BIN)/ruff format --check .
	@$(BIN)/mypy

clean:
	rm -rf $(VENV) build install log $(DEMO) *.egg-info
