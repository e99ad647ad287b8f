"""One engine run of TORA, recorded, for all tests of the bags."""

import pytest
from recorded_run import Recorded, record


@pytest.fixture(scope="session")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> Recorded:
    return record(tmp_path_factory.mktemp("bags") / "deep" / "tora")
