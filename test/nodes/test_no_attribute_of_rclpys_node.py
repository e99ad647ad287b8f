"""No node of ours has an attribute of the name of one of rclpy's own.

The recorder had a ``_parameters``: whoever asked for its parameters ended it, and the run.
"""

import ast
import inspect
import pkgutil
from importlib import import_module

import pytest
from rclpy.lifecycle.node import LifecycleNodeMixin
from rclpy.node import Node

from fpt_ros import nodes

MEANT = {"on_activate", "on_cleanup", "on_deactivate", "on_shutdown"}  # said by the life cycle
REFUSING = {"set_parameters", "set_parameters_atomically"}  # the deformer's, which call rclpy's


def set_by(kind):
    """Names of what the class sets on ``self``, and of its methods."""
    tree = ast.parse(inspect.getsource(inspect.getmodule(kind)))
    (own,) = (n for n in ast.walk(tree) if isinstance(n, ast.ClassDef) and n.name == kind.__name__)
    stored = {
        each.attr
        for each in ast.walk(own)
        if isinstance(each, ast.Attribute)
        and isinstance(each.ctx, ast.Store)
        and isinstance(each.value, ast.Name)
        and each.value.id == "self"
    }
    return stored | {each.name for each in own.body if isinstance(each, ast.FunctionDef)}


def kinds():
    for module in pkgutil.iter_modules(nodes.__path__, f"{nodes.__name__}."):
        for each in vars(import_module(module.name)).values():
            ours = inspect.isclass(each) and each.__module__ == module.name
            if ours and issubclass(each, Node):
                yield each


@pytest.mark.parametrize("kind", list(kinds()), ids=lambda kind: kind.__name__)
def test_no_attribute_of_rclpys_node_is_hidden(kind):
    theirs = set_by(Node) | set(dir(Node)) | set_by(LifecycleNodeMixin)
    assert "_parameters" in theirs
    hidden = set_by(kind) & theirs - {"__init__"} - MEANT
    assert hidden <= (REFUSING if kind.__name__ == "DeformerNode" else set())
