"""Files that lack a section or misspell a parameter."""

import pytest
from refusals import NODES, refused


@pytest.mark.parametrize("section", NODES)
def test_a_missing_section(own, section):
    path, replace = own
    replace(f"/**/{section}:", f"/**/{section}_gone:")
    message = refused(str(path))
    assert message == f"{path} lacks the section '{section}': it takes {', '.join(NODES)}"


def test_a_section_too_many_is_told_of_the_file_that_has_it(own):
    path, _ = own
    extra = "/**/plant:\n  ros__parameters: {dt: 1.0}\n"
    overlay = path.with_name("mine.more.yaml")
    overlay.write_text(extra)
    expected = f"there is no node 'plant', only {', '.join(NODES)}"
    assert refused(str(path), "more") == f"{overlay}: {expected}"
    path.write_text(path.read_text() + extra)
    assert refused(str(path)) == f"{path}: {expected}"


def test_a_missing_parameter(own):
    path, replace = own
    replace("    dt: 0.001\n", "")
    assert refused(str(path)) == "plant_simulator.dt is missing: it takes a number > 0 [s]"


def test_a_misspelt_parameter(own):
    path, replace = own
    replace("    guard: true\n", "    gaurd: true\n")
    assert refused(str(path)).startswith("fpt_deformer has no parameter 'gaurd': it has ")


def test_a_misspelt_shared_parameter(own):
    path, replace = own
    replace("    model: tora\n", "    model: tora\n    adaptive_form: 2.0\n")
    message = refused(str(path))
    assert message.startswith(f"{path}: no node has the parameter 'adaptive_form' of the section")
    assert "adaptive_from" in message


def test_a_misspelt_parameter_in_a_variant(own):
    path, _ = own
    overlay = path.with_name("mine.bad.yaml")
    overlay.write_text("/**/fpt_deformer:\n  ros__parameters: {a: -0.05}\n")
    assert refused(str(path), "bad").startswith("fpt_deformer has no parameter 'a': it has A, ")


def test_a_file_that_is_missing_or_no_yaml(tmp_path):
    assert "cannot be read: No such file" in refused(str(tmp_path / "none.yaml"))
    (tmp_path / "bad.yaml").write_text("a: [")
    assert "is not YAML" in refused(str(tmp_path / "bad.yaml"))
