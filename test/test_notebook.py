"""The notebook of the docs runs from its first cell to its last, and draws."""

from pathlib import Path

import nbformat
from nbclient import NotebookClient

NOTEBOOK = Path(__file__).parents[1] / "docs" / "recording.ipynb"


def pictures(notebook):
    outputs = [output for cell in notebook.cells for output in cell.get("outputs", ())]
    return sum("image/png" in output.get("data", {}) for output in outputs)


def test_the_notebook_runs_and_is_shown_as_it_runs():
    shown = nbformat.read(NOTEBOOK, as_version=4)
    ran = nbformat.read(NOTEBOOK, as_version=4)
    NotebookClient(ran, resources={"metadata": {"path": NOTEBOOK.parent}}).execute()
    assert pictures(ran) == 3
    assert pictures(shown) == pictures(ran)
    assert nbformat.validate(shown) is None
