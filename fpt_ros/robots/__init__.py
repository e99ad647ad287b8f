"""An experiment for any arm: from its description file to parameter files that run.

``survey.py`` looks at the arm, ``motion.py`` finds a nominal motion that it can follow, and
``experiment_files.py`` writes the experiment ``panda`` and its variants with the arm's own numbers.
"""
