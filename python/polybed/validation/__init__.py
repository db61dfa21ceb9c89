"""Beds that were measured, against the models: entries, their runs, verdicts and records. The command is `polybed validate`."""
