#!/usr/bin/python3
"""Every relative link of a page names a file of the repository, and a heading of it where it names one; no page of docs is out of reach.
A file that a source names with its folder exists."""
import re
import sys

from sources import ROOT, report, tracked

LINK = re.compile(r"\]\(([^)\s]+)\)")
FENCED = re.compile(r"^```.*?^```", re.M | re.S)


def anchors(text):
    """Of each heading the name that a link gives it: small letters, digits, _ and -; of equal ones the later are numbered."""
    found = {}
    for heading in re.findall(r"^#+ +(.*?) *$", FENCED.sub("", text), re.M):
        plain = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading).lower()
        name = re.sub(r"[^\w\- ]", "", plain).replace(" ", "-")
        found[name] = found.get(name, -1) + 1
    return {name if n == 0 else f"{name}-{n}" for name, last in found.items() for n in range(last + 1)}


def targets(path, text):
    """(link, file, heading) of each relative link of a page."""
    for link in LINK.findall(re.sub(r"`[^`\n]*`", "", FENCED.sub("", text))):
        if not re.match(r"[a-z]+:", link):
            name, _, heading = link.partition("#")
            yield link, (path.parent / name).resolve() if name else path, heading


def broken(path, text):
    for link, file, heading in targets(path, text):
        if not file.exists():
            yield f"the link {link} names no file"
        elif heading and heading not in anchors(file.read_text()):
            yield f"the link {link} names no heading"


NAMED = re.compile(r"(?<![\w./{}-])((?:app|cases|closures|core|dem|docs|fluid|measures|multiscale|python|relevance|tests|tfm)/[\w./-]*\.(?:md|hpp|cpp|py))\b")


def gone(text):
    """Files of this repository that a text names and that there are not; an example in a test has no such folder."""
    return sorted({name for name in NAMED.findall(text) if not (ROOT / name).exists()})


def unreached(pages):
    """Pages of docs that no chain of links from the README leads to."""
    left, seen = [ROOT / "README.md"], set()
    while left:
        page = left.pop()
        if page not in seen and page in pages:
            seen.add(page)
            left += [file for _, file, _ in targets(page, page.read_text())]
    return [p for p in pages if p.is_relative_to(ROOT / "docs") and p not in seen]


def self_test():
    assert anchors("# A `b`, c\n## Two\n## Two\n```\n# no\n```\n") == {"a-b-c", "two", "two-1"}
    here = ROOT / "README.md"
    assert list(broken(here, "[a](no-such-file.md)")) == ["the link no-such-file.md names no file"]
    assert list(broken(here, "[a](README.md#no-such-heading)")) == ["the link README.md#no-such-heading names no heading"]
    assert gone("// docs/effects.md and docs/reference/effects.md") == ["docs/effects.md"]
    assert not list(broken(here, "[a](https://example.org) [b](README.md#polybed) `[c](no)`"))


if __name__ == "__main__":
    self_test()
    pages = tracked(".md")
    problems = [f"{p.relative_to(ROOT)}: {problem}" for p in pages for problem in broken(p, p.read_text())]
    problems += [f"{p.relative_to(ROOT)}: no page links to it" for p in unreached(pages)]
    sources = [p for p in tracked(".hpp", ".cpp", ".py") if p.parent != ROOT / "tests/architecture"]
    problems += [f"{p.relative_to(ROOT)}: {name} is gone" for p in sources for name in gone(p.read_text())]
    sys.exit(report(problems, "links of the docs"))
