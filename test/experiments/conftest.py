"""A parameter file that a test may spoil."""

import shutil

import pytest

from fpt_ros.experiments.locate import config_directory


@pytest.fixture
def own(tmp_path):
    """A copy of the TORA file that a test may spoil; returns (path, replace)."""
    path = tmp_path / "mine.yaml"
    shutil.copy(config_directory() / "tora.yaml", path)

    def replace(old, new):
        content = path.read_text()
        assert old in content
        path.write_text(content.replace(old, new))

    return path, replace
