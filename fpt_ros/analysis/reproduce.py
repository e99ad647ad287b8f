"""The page about what reproduces: every claim of the thesis, judged, with its figures."""
