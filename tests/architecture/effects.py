#!/usr/bin/python3
"""An effect is named by its entry, by one maker in each model that acts, and by the lists: with its formula, the formula's test and the
docs row that is at most six files for an effect of one model (docs/guide/add-a-force.md)."""
import re
import sys

from sources import ROOT, report, tracked

FOLDERS = ("app", "core", "closures", "relevance", "fluid", "dem", "tfm", "multiscale")
# What other code rests on: forces are balanced by the drag, boxes of particles touch, a continuum's solids have a pressure.
RESTED_ON = {"drag", "contact", "solids_stress", "granular_temperature", "solids_viscosity", "species_exchange", "lubrication", "added_mass",
             "fluid_stress", "gas_slip", "partition", "shape", "rolling"}
BESIDE = 3  # formula, its test, docs row


def listed(model):
    """Names in the list of a model."""
    return re.findall(r"&(\w+),", (ROOT / model / "effects/list.cpp").read_text())


def names_it(text, effect):
    return re.search(rf'&{effect},|effects::{effect}\b|effects\.{effect}\b|role = "{effect}"|\("{effect}"\)|, "{effect}"\)|effects\["{effect}"\]',
                     text) is not None


def self_test():
    assert names_it('if (core::law_of(scene, "lift") != "none")', "lift") and names_it('scene.effects["lift"] = law;', "lift")
    assert not names_it('{{"history", *scene.output.history_every,', "history") and not names_it("lifted", "lift")


if __name__ == "__main__":
    self_test()
    texts = {str(p.relative_to(ROOT)): p.read_text() for p in tracked(".hpp", ".cpp") if str(p.relative_to(ROOT)).split("/")[0] in FOLDERS}
    problems = []
    effects = {effect: [model for model in ("dem", "tfm") if effect in listed(model)] for model in ("dem", "tfm") for effect in listed(model)}
    if len(effects) < 10:
        problems.append(f"only {sorted(effects)} are listed: the lists are not read")
    for effect, models in sorted(effects.items()):
        if f"relevance/effects/{effect}.hpp" not in texts:
            problems.append(f"relevance/effects/{effect}.hpp: no entry of {effect}")
        files = [name for name, text in texts.items() if names_it(text, effect)]
        most = 6 - BESIDE + 2 * (len(models) - 1)  # a second model has a maker and a list of its own
        if effect not in RESTED_ON and len(files) > most:
            problems.append(f"{effect} is named in {len(files)} files of the product, at most {most}: {', '.join(files)}")
    sys.exit(report(problems, "effects"))
