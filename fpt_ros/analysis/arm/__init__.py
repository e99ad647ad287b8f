"""An arm in its motion: a picture and a short film of a run, its nominal motion as a ghost.

``film.py`` takes the motion from a run and asks another process for the pictures, because OpenGL is
chosen before MuJoCo is imported, and may take its process with it. That process is ``artist.py``:
MuJoCo's own renderer (``rendered.py``) where OpenGL is there, lines between the joints otherwise
(``lines.py``).
"""
