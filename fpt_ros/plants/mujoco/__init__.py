"""Robot arms from a file, MJCF or URDF: plant and model on the rigid body dynamics of MuJoCo.

``description_file.py`` reads the file, ``description.py`` makes an arm of it, ``library.py`` finds
MuJoCo's C functions, ``plant.py``, ``model.py`` and ``diagonal.py`` are the laws that call them;
``linear.py``, on ``regressor.py``, is a model whose numbers are learned. ``arms/`` holds the
descriptions that ship. MuJoCo is an extra: ``pip install fpt_ros[robots]``.

Coordinates are the joints that turn or slide, in the order of the file; those that are not named in
``joints`` are fixed where the file has them. A file's actuators, contacts, key frames and sensors
are left out: effort acts at the joints.
"""
