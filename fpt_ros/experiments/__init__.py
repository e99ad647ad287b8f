"""Experiments: parameter files, their variants, and whether what they name fits together."""
