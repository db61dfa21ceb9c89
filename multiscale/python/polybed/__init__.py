"""Reads and draws the runs of polybed. It computes no physics."""

from polybed.read import FormatError, Run, read

__all__ = ["FormatError", "Run", "read"]
