#!/usr/bin/python3
"""Choices are enums, and laws have traits: text is compared with literals only where text is read, in READERS."""
import re
import sys

from sources import ROOT, report, tracked

COMPARED = re.compile(r'[!=]=\s*"(?:[^"\\]|\\.)*"(?!\s*_)|"(?:[^"\\]|\\.)*"\s*[!=]=(?!=)')
FOLDERS = ("closures", "core", "relevance", "fluid", "measures", "tfm", "dem", "multiscale", "app")
# files that read or write a case, read another file, or the words of a command
READERS = {f"{name}.cpp" for name in (
    *(f"core/case/{n}" for n in ("contact_properties", "file", "resolved", "scene", "units", "values")),
    "core/output/directory", "core/output/profiles",
    "app/drag", "app/estimate", "app/inversion", "app/inversion_scan", "app/keys", "app/measure", "app/measure_text", "app/plot",
    "app/run_directory")}


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
    problems = [f"{name}: compares with no text any more: not a reader" for name in sorted(READERS)
                if not (ROOT / name).exists() or not comparisons((ROOT / name).read_text())]
    for path in tracked(".cpp", ".hpp"):
        name = str(path.relative_to(ROOT))
        if name.startswith(FOLDERS) and name not in READERS:
            problems += [f"{name}:{n}: compares with text: ask for a property of the choice, or make it an enum"
                         for n in comparisons(path.read_text())]
    sys.exit(report(problems, "words"))
