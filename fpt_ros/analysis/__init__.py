"""What a run was worth: its numbers, figures, tables and the report page."""
