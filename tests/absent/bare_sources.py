#!/usr/bin/python3
"""Writes the registries without lift and cohesion of particles and without the exchange of species and the viscosity of packed solids of
the continuum: bare_sources.py ROOT OUTPUT_FOLDER."""
import pathlib
import re
import sys


def without(text, pattern, count):
    """The text without what a pattern matches, which has to be there: a registry that has changed must not go unread."""
    text, found = re.subn(pattern, "", text, flags=re.M | re.S)
    assert found == count, f"{found} matches, not {count}: {pattern}"
    return text


def bare_side_forces(text):
    text = without(text, r'^#include "dem/effects/lift\.hpp"\n', 1)
    return without(text, r'^  if \(calls_for\(scene, "lift"\)\).*?;\n', 1)


def bare_effects(text):
    text = without(text, r'^#include "dem/effects/cohesion\.hpp"\n', 1)
    text = without(text, r"^std::unique_ptr<CohesionLaw> make_cohesion\(.*?^}\n", 1)
    return without(text, r"^  laws\.cohesion = .*?;\n", 1)


def bare_tfm_effects(text):
    text = without(text, r'^#include "tfm/effects/(species_exchange_syamlal|species_exchange_table|solids_viscosity_frictional)\.hpp"\n', 3)
    text = without(text, r"^    if \(constants\.species\(\) > 1\)\n      effects\.species_exchange = .*?;\n", 1)
    text = without(text, r"^    effects\.species_exchange = .*?;\n", 1)
    return without(text, r"^  if \(viscosity == [^\n]*\n    effects\.solids_viscosity = .*?;\n  else ", 1)


if __name__ == "__main__":
    root, output = map(pathlib.Path, sys.argv[1:3])
    output.mkdir(parents=True, exist_ok=True)
    for source, name, bare in (("dem/effects/side_forces", "side_forces", bare_side_forces), ("dem/effects", "effects", bare_effects),
                               ("tfm/effects", "tfm_effects", bare_tfm_effects)):
        (output / f"bare_{name}.cpp").write_text(bare((root / f"{source}.cpp").read_text()))
