#!/usr/bin/python3
"""Choices are enums: text is compared with literals only where text is read, in READERS. Elsewhere what remains may only fall."""
import collections
import re
import sys

from sources import ROOT, report, tracked

COMPARED = re.compile(r'[!=]=\s*"(?:[^"\\]|\\.)*"(?!\s*_)|"(?:[^"\\]|\\.)*"\s*[!=]=(?!=)')
FOLDERS = ("closures", "core", "relevance", "fluid", "measures", "tfm", "dem", "multiscale", "app")
# files that read or write a case, read another file, or the words of a command
READERS = {f"{name}.cpp" for name in (
    *(f"core/case/{n}" for n in ("contact_properties", "file", "resolved", "scene", "units", "values")),
    "core/output/directory", "core/output/history", "core/output/profiles", "fluid/solids_table", "multiscale/case_differences",
    "app/asking", "app/drag", "app/estimate", "app/plot", "app/run_directory")}
# folder -> comparisons that remain, with what; lower the number with every one that goes
REMAIN = {
    "app": 10,                    # laws of [effects], names of timers, words of a command
    "dem": 1,                    # laws of [effects]
    "dem/coupling": 1,            # laws of [effects]
    "dem/effects": 12,            # laws of [effects], each in its own maker
    "fluid": 2,                   # laws of [effects]
    "measures": 1,                # the unit of a number
    "relevance": 9,               # laws of [effects], zones of a bed
    "relevance/effects": 13,      # laws of [effects], zones of a bed
    "multiscale": 3,              # laws of [effects], the name of a score
    "multiscale/calibrate": 3,    # laws of [effects]
    "multiscale/effects": 17,     # names of effects, laws and zones
    "tfm": 4,                    # laws of [effects]
    "tfm/effects": 5,             # laws of [effects], each in its own maker
}


def comparisons(text):
    """The numbers of lines that compare with a literal, once for each comparison; comments and the insides of literals left out."""
    found = []
    for number, line in enumerate(text.split("\n"), 1):
        code = re.sub(r'//.*|"(?:[^"\\]|\\.)*"', lambda m: "" if m[0].startswith("//") else '"' + "x" * (len(m[0]) - 2) + '"', line)
        found += [number] * len(COMPARED.findall(code))
    return found


def self_test():
    assert comparisons('if (a == "none" || "b" != c) {}  // x == "y"\nz = "a == \\"b\\"";') == [1, 1]
    assert not comparisons('a = f("x == 1");')


if __name__ == "__main__":
    self_test()
    counts, places, problems = collections.Counter(), collections.defaultdict(list), []
    for path in tracked(".cpp", ".hpp"):
        name = str(path.relative_to(ROOT))
        if not name.startswith(FOLDERS) or name in READERS:
            continue
        folder = "/".join(name.split("/")[:-1])
        lines = comparisons(path.read_text())
        counts[folder] += len(lines)
        places[folder] += [f"{name}:{n}" for n in lines]
    for folder in sorted(set(counts) | set(REMAIN)):
        now, most = counts[folder], REMAIN.get(folder, 0)
        if now > most:
            problems += [f"{folder}: {now} comparisons with text, at most {most}: make the choice an enum", *places[folder]]
        if now < most:
            print(f"{folder}: {now} comparisons with text remain, {most} are stated: lower the number")
    sys.exit(report(problems, "words"))
