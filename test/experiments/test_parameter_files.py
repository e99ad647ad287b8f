"""ROS 2 parameter files: read, written, laid over each other."""

import struct

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from fpt_ros.errors import BadInput
from fpt_ros.experiments import parameter_file
from fpt_ros.experiments.parameter_file import ParameterFile

finite = st.floats(allow_nan=False, allow_infinity=False)
name = st.from_regex(r"[a-z][a-z_]{0,8}(\.[a-z]{1,5})?", fullmatch=True)
AWKWARD = [
    "no",
    "yes",
    "on",
    "off",
    "y",
    "true",
    "null",
    "~",
    "1.0",
    "1e5",
    "0x10",
    "",
    " ",
    "a: b",
]
text = st.one_of(
    st.sampled_from(AWKWARD),
    st.text(st.characters(min_codepoint=32, max_codepoint=0x2FF, exclude_categories=["Cc"])),
)
value = st.one_of(
    st.booleans(),
    st.integers(-(2**63), 2**63 - 1),
    finite,
    text,
    st.lists(finite, min_size=1, max_size=4),
    st.lists(text, min_size=1, max_size=3),
)


def written(tmp_path, content):
    path = tmp_path / "some.yaml"
    path.write_text(content, encoding="utf-8")
    return path


def bits(item):
    if isinstance(item, float):
        return struct.pack("<d", item)
    return [bits(each) for each in item] if isinstance(item, list) else (type(item), item)


@settings(deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.dictionaries(name, value, min_size=1, max_size=6))
def test_what_is_written_is_read_again(tmp_path, values):
    """To the last bit of every double; words that look like something else stay words."""
    path = tmp_path / "round.yaml"
    parameter_file.write(path, {"fpt_deformer": values, "denoiser": {"method": "none"}})
    file = parameter_file.read(path)
    assert file.shared == {}
    assert file.nodes["denoiser"] == {"method": "none"}
    assert {key: bits(item) for key, item in file.nodes["fpt_deformer"].items()} == {
        key: bits(item) for key, item in values.items()
    }


def test_words_are_quoted_numbers_are_not_and_empty_lists_are_left_out(tmp_path):
    path = tmp_path / "out.yaml"
    values = {"form": "no", "A": -0.1, "K": -1e5, "seed": 3, "guard": True, "start": [], "v": [1.0]}
    parameter_file.write(path, {"node": values})
    lines = path.read_text().split("\n")
    assert lines[:2] == ["/**/node:", "  ros__parameters:"]
    entries = {line.strip() for line in lines[2:] if line.strip()}
    assert entries == {
        'form: "no"', "A: -0.1", "K: -100000.0", "seed: 3", "guard: true", "v: [1.0]"
    }  # fmt: skip


def test_sections_names_and_namespaces(tmp_path):
    path = written(
        tmp_path,
        """
/**:
  ros__parameters: {model: tora, approximate: {m: 10.0, deep: {er: 1}}}
/**/denoiser:
  ros__parameters: {method: no}
/robot/arm/fpt_deformer:
  ros__parameters: {A: -1.0e-1, form: norm}
plant_simulator:
  ros__parameters: {"exact.m": 20, initial_position: [0, 1.5]}
/**/fpt_deformer:
  ros__parameters: {A: 1e-6}
""",
    )
    file = parameter_file.read(path)
    assert file.shared == {"model": "tora", "approximate.m": 10.0, "approximate.deep.er": 1}
    assert file.nodes == {
        "denoiser": {"method": "no"},
        "fpt_deformer": {"A": 1e-6, "form": "norm"},
        "plant_simulator": {"exact.m": 20, "initial_position": [0, 1.5]},
    }
    assert isinstance(file.nodes["fpt_deformer"]["A"], float)


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        ("a: [1,", "is not YAML"),
        ("a: b: c", "is not YAML"),
        ("a: 1\na: 2\n", "is not YAML"),
        ("\tx: 1", "is not YAML"),
        ("", "is not a ROS 2 parameter file: it has to be sections by node name"),
        ("- a", "is not a ROS 2 parameter file"),
        ("tora", "is not a ROS 2 parameter file"),
        ("fpt_deformer: {A: 1.0}", "section 'fpt_deformer' has to hold a map 'ros__parameters'"),
        ("fpt_deformer:\n  ros__parameters:\n", "section 'fpt_deformer' has to hold a map"),
        ("fpt_deformer:\n  ros__parameters: [1]\n", "section 'fpt_deformer' has to hold a map"),
        ("fpt_deformer: 3", "section 'fpt_deformer' has to hold a map"),
    ],
)
def test_files_that_are_none(tmp_path, content, reason):
    path = written(tmp_path, content)
    with pytest.raises(BadInput) as caught:
        parameter_file.read(path)
    message = str(caught.value)
    assert message.startswith(str(path))
    assert reason in message
    assert "\n" not in message


def test_the_line_of_a_mistake_is_told(tmp_path):
    with pytest.raises(BadInput, match=r"\(line 3\)"):
        parameter_file.read(written(tmp_path, "a:\n  b: 1\n  c: d: 2\n"))


def test_files_that_cannot_be_read(tmp_path):
    with pytest.raises(BadInput, match=r"missing\.yaml cannot be read: No such file"):
        parameter_file.read(tmp_path / "missing.yaml")
    with pytest.raises(BadInput, match="cannot be read: Is a directory"):
        parameter_file.read(tmp_path)
    path = tmp_path / "latin.yaml"
    path.write_bytes(b"a: \xe9\xff")
    with pytest.raises(BadInput, match=r"latin\.yaml cannot be read: not UTF-8 text"):
        parameter_file.read(path)


def test_overlay_goes_on_top_and_leaves_both_files_alone():
    base = ParameterFile({"g": 9.81, "m": 1.0}, {"a": {"x": 1, "y": 2}, "b": {"z": 3}})
    top = ParameterFile({"m": 2.0}, {"a": {"y": 5}, "c": {"w": 6}})
    both = base.overlay(top)
    assert both.shared == {"g": 9.81, "m": 2.0}
    assert both.nodes == {"a": {"x": 1, "y": 5}, "b": {"z": 3}, "c": {"w": 6}}
    both.nodes["b"]["z"] = both.shared["g"] = 0
    both.nodes["c"]["w"] = 0
    assert base == ParameterFile({"g": 9.81, "m": 1.0}, {"a": {"x": 1, "y": 2}, "b": {"z": 3}})
    assert top == ParameterFile({"m": 2.0}, {"a": {"y": 5}, "c": {"w": 6}})


@pytest.mark.parametrize(
    ("given_text", "expected"),
    [
        ("-0.2", -0.2),
        ("1e-6", 1e-6),
        ("1.0e+5", 1e5),
        ("3", 3),
        ("true", True),
        ("no", "no"),
        ("off", "off"),
        ("sgfpt", "sgfpt"),
        ("[0.0, 1, 2.5]", [0.0, 1, 2.5]),
        ("[q3, q2]", ["q3", "q2"]),
        ('"1.0"', "1.0"),
        ("", None),
    ],
)
def test_values_of_the_command_line(given_text, expected):
    found = parameter_file.scalar(given_text)
    assert found == expected
    assert type(found) is type(expected)


@pytest.mark.parametrize("given_text", ["[1,", "{a", '"x'])
def test_a_value_that_is_not_yaml(given_text):
    with pytest.raises(BadInput, match="is not a YAML value") as caught:
        parameter_file.scalar(given_text)
    assert "\n" not in str(caught.value)
