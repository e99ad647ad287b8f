"""Panels as plots of a page: zoom and pan linked in time, hover, legends that hide (Bokeh)."""
