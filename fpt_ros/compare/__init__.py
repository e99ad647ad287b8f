"""All controllers of an experiment under all its circumstances, on one page: ``fpt compare``.

``field.py`` says who meets what, ``measures.py`` what is measured of a run, ``task.py`` makes the
runs of one controller in one group of circumstances, and tunes it there first, ``compare.py`` all
of them; ``results.py``, ``verdicts.py``, ``figures.py`` and ``page.py`` say what was found.
"""
