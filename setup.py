"""Of the Python package: notes the folder that pip installs it from, where the program is built. pyproject.toml says the rest."""
from pathlib import Path

from setuptools import setup
from setuptools.command.build_py import build_py


class Noted(build_py):
    def run(self):
        super().run()
        if not self.editable_mode:
            Path(self.build_lib, "polybed/sources.txt").write_text(str(Path(__file__).resolve().parent), encoding="utf-8")


setup(cmdclass={"build_py": Noted})
