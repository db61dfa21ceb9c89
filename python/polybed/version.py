"""The version of polybed. CMake, pyproject.toml and the documentation read it here."""

__version__ = "0.1.0"
