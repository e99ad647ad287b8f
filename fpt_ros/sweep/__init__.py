"""Many runs of an experiment: sweeps over parameters, and the search for good ones."""
