"""The command ``fpt``, one file a command."""
