"""A page to watch running graphs on, and to change their parameters while they run.

``robots.py`` keeps what the graphs of the ROS domain have told last, ``page.py`` shows it in a
browser, ``server.py`` hands it out to who has the token. What talks ROS is in ``nodes/``:
``recent.py`` (a node tells its last messages), ``listening.py``, ``asking.py``.
"""
