"""Tables as people have them, read right or refused in one line that names the line of the file.

:func:`~fpt_ros.tables.reading.read` takes a file of any kind: text with any separator and decimal
mark, JSON, arrays of NumPy and MATLAB, Parquet, WAV, each of them compressed or not, or standard
input. It gives a :class:`~fpt_ros.tables.table.Table`; :mod:`~fpt_ros.tables.time_axis` finds the
column of times in it, :mod:`~fpt_ros.tables.spacing` how the samples lie in time, and
:mod:`~fpt_ros.tables.writing` writes tables. It knows nothing of runs, recordings and denoising.
"""
