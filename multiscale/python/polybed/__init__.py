"""Reads and draws the runs of polybed. It computes no physics."""

from polybed.read import FormatError, Particles, Run, read

__all__ = ["FormatError", "Particles", "Run", "read"]
