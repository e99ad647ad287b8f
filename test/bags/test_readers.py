"""What others read of our recordings: the same messages with the same numbers and words."""

from pathlib import Path

import pytest
import readers
from damaged import recording

from fpt_ros.bags.flat import write_flat
from fpt_ros.bags.reader import info
from fpt_ros.bags.recover import recover
from fpt_ros.bags.split import Split

BAGS = Path(__file__).parents[2] / "bags"
SHIPPED = ("tora", "tora_nonadaptive", "noisy_tora", "panda")


@pytest.fixture(scope="module")
def bags(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """Those that ship, and what was split, recovered, or made for viewers."""
    folder = tmp_path_factory.mktemp("readers")
    recording(folder / "split", 1200, split=Split(size=65536))
    cut = recording(folder / "cut")
    cut.write_bytes(cut.read_bytes()[: cut.stat().st_size * 2 // 3])
    recover(cut, folder / "recovered")
    (folder / "flat").mkdir()
    write_flat(BAGS / "panda", folder / "flat" / "flat.mcap")
    made = {name: folder / name for name in ("split", "recovered", "flat")}
    return {**{name: BAGS / name for name in SHIPPED}, **made}


@pytest.fixture(scope="module")
def ours(bags: dict[str, Path]) -> dict[str, readers.Digests]:
    return {name: readers.by_us(path) for name, path in bags.items()}


def files(directory: Path) -> list[Path]:
    return [directory / name for name in info(directory)["files"]]  # type: ignore[attr-defined]


@pytest.mark.parametrize("name", SHIPPED)
def test_shipped_recordings_are_whole_and_small(name: str) -> None:
    about = info(BAGS / name)
    assert (about["complete"], about["missing"], about["notes"]) == (True, [], [])
    assert sum(path.stat().st_size for path in (BAGS / name).iterdir()) < 1_000_000


def test_rosbags(bags: dict[str, Path], ours: dict[str, readers.Digests]) -> None:
    for name, path in bags.items():
        if name != "flat":  # a file alone, without metadata.yaml
            assert readers.by_rosbags(path) == ours[name], name


def test_mcap_with_ros2_support(bags: dict[str, Path], ours: dict[str, readers.Digests]) -> None:
    for name, path in bags.items():
        assert readers.by_mcap(files(path)) == ours[name], name


def test_readers_of_foxglove(bags: dict[str, Path], ours: dict[str, readers.Digests]) -> None:
    found = readers.by_node([files(path) for path in bags.values()])
    for (name, expected), digests in zip(ours.items(), found, strict=True):
        assert digests == expected, name
