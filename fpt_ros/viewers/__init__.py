"""Layouts of the programs that people look at recordings with: one description, a file a program.

``fpt layout`` makes one for any recording of a loop; those in share/fpt_ros/layouts are made by it.
"""

from fpt_ros.viewers import foxglove, plotjuggler

PROGRAMS = {"foxglove": (foxglove.text, ".json"), "plotjuggler": (plotjuggler.text, ".xml")}
"""What makes the layout of a program of its pages, and how its file ends."""
