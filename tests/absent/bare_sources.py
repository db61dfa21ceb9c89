#!/usr/bin/python3
"""Writes the lists of effects without lift and cohesion of particles and without lift, added mass, the exchange of species and
the viscosity of packed solids of the continuum: bare_sources.py ROOT OUTPUT_FOLDER."""
import pathlib
import re
import sys

BARE = {"dem": ("lift", "cohesion"), "tfm": ("species_exchange", "solids_viscosity", "lift", "added_mass")}


def without(text, effects):
    """The list without these effects, which have to be there: a list that has changed must not go unread."""
    for effect in effects:
        text, found = re.subn(rf"&{effect},\s*", "", text)
        assert found == 1, f"{found} times &{effect}"
    return text


if __name__ == "__main__":
    root, output = map(pathlib.Path, sys.argv[1:3])
    output.mkdir(parents=True, exist_ok=True)
    for model, effects in BARE.items():
        (output / f"bare_{model}_effects.cpp").write_text(without((root / model / "effects/list.cpp").read_text(), effects))
