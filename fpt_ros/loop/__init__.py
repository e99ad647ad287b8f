"""The control loop: its stages, the experiments that configure them, and the in-process engine."""
