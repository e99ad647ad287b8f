"""Runs as arrays: what an engine or a recording gives, and the analysis takes."""
