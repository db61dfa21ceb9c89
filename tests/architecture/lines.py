#!/usr/bin/python3
"""The ratchet: folders contain no more lines, and docs no more words, than lines.txt says, and its numbers only fall.

    lines.py            fails where a number is exceeded, and asks for a lower one where less is left
    lines.py --lower    lowers the numbers to the measured ones
    lines.py --rewrite  writes the measured numbers, higher ones too: for a commit of its own whose body says what for
"""
import pathlib
import sys
from collections import Counter

from sources import ROOT, report, tracked

FILE = pathlib.Path(__file__).with_name("lines.txt")
CODE = (".cpp", ".hpp", ".c", ".py", ".js", ".css", ".cmake", "CMakeLists.txt")
TOP = "top"  # files of the root
HEAD = """# Lines of code per folder, and words per part of the docs. They only fall: tests/architecture/lines.py --lower.
# A feature raises its folder's number in a commit of its own whose body says what for (lines.py --rewrite).
"""


def measured(code, pages):
    """Numbers by name, from (path, text) of both."""
    numbers = Counter()
    for path, text in code:
        numbers["lines " + (path.parts[0] if len(path.parts) > 1 else TOP)] += text.count("\n")
    for path, text in pages:
        if path.name == "CHANGELOG.md":  # grows with each release
            continue
        part = path.parts[:2] if path.parts[0] == "docs" and len(path.parts) > 2 else path.parts[:1] if len(path.parts) > 1 else (TOP,)
        numbers["words " + "/".join(part)] += len(text.split())
    return numbers


def numbers_of(text):
    return {line.rsplit(" ", 1)[0]: int(line.rsplit(" ", 1)[1]) for line in text.split("\n") if line and line[0] != "#"}


def text_of(numbers):
    return HEAD + "".join(f"{name} {number}\n" for name, number in sorted(numbers.items()) if number)


def exceeded(limits, numbers):
    return [f"{name}: {number}, at most {limits.get(name, 0)}" for name, number in sorted(numbers.items()) if number > limits.get(name, 0)]


def lowered(limits, numbers):
    return {name: min(limit, numbers.get(name, 0)) for name, limit in limits.items()}


def self_test():
    path = pathlib.PurePath
    numbers = measured([(path("a/b/c.py"), "1\n2\n"), (path("a/d.cpp"), "3\n"), (path("e.py"), "4\n")],
                       [(path("docs/guide/f.md"), "one two"), (path("README.md"), "three"), (path("CHANGELOG.md"), "four")])
    assert numbers == {"lines a": 3, "lines top": 1, "words docs/guide": 2, "words top": 1}
    assert numbers_of(text_of(numbers)) == numbers
    assert not exceeded(numbers, numbers) and exceeded({"lines a": 2}, {"lines a": 3}) and exceeded({}, {"lines new": 1})
    assert lowered({"lines a": 4, "lines b": 1, "lines gone": 9}, {"lines a": 3, "lines b": 2}) == {"lines a": 3, "lines b": 1, "lines gone": 0}


if __name__ == "__main__":
    self_test()
    numbers = measured(*([(path.relative_to(ROOT), path.read_text()) for path in tracked(*suffixes)] for suffixes in (CODE, (".md",))))
    limits = numbers_of(FILE.read_text()) if FILE.exists() else {}
    if sys.argv[1:] == ["--lower"]:
        FILE.write_text(text_of(lowered(limits, numbers)))
    elif sys.argv[1:] == ["--rewrite"]:
        FILE.write_text(text_of(numbers))
    else:
        less = [name for name, limit in limits.items() if numbers[name] < limit]
        if less:
            print(f"less than lines.txt says: {', '.join(less)}. Lower it: tests/architecture/lines.py --lower")
        sys.exit(report(exceeded(limits, numbers), "lines"))
