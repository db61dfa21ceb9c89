#!/usr/bin/python3
"""Files stay short, nothing is left over, no machine's paths, sources are formatted, messages are printed and files opened in one way,
effects and laws have tests and docs."""
import re
import shutil
import subprocess
import sys

from sources import ROOT, report, tracked

LONGEST = 400
ARGUED = "Longer than 400 lines because"
LEFT_OVER = re.compile(r"\b(TO" + r"DO|FIX" + r"ME|XX" + r"X|HA" + r"CK)\b")
PRINTED = re.compile(r"\bfmt::print\(|\bstd::(cout|cerr|printf|fprintf|puts|fputs)\b")
# Whoever opens a file to read asks whether it is one: a pipe never ends, and a link of HDF5 leads anywhere.
OPENED = {"cpp": re.compile(r"\bstd::ifstream\b|\bfopen\(|(?<!\w)::open\(|\bH5[FD]open2?\("),
          "py": re.compile(r"(?<![\w.])open\((?!.*\"[wx]b?\")|\bos\.open\(|\.read_(text|bytes)\(|\bh5py\.File\((?!.*\"w\")")}
OPENERS = {"core/output/files.cpp", "core/output/file.cpp", "python/polybed/files.py",
           "core/output/blocks.cpp",  # what they have written
           "core/output/directory.cpp",  # the mark
           "core/memory.cpp", "multiscale/run_record.cpp", "python/polybed/cost/report.py",  # of the system
           "app/process.cpp", "python/polybed/ending.py", "python/polybed/isolated.py"}
SHIPPED = re.compile(r"__file__|\bBANDS\b")  # files of the package itself
MACHINE = re.compile(r"(^|[^\w./])/(work|root|home|tmp)/")


def too_long(name, text):
    lines = text.count("\n")
    return [f"{name}: {lines} lines, at most {LONGEST}"] if lines > LONGEST and ARGUED not in text[:2000] else []


def ill_named(name):
    return [] if re.fullmatch(r"[\w./-]+", name) else [f"{name}: a file's name is of letters, digits, '.', '_' and '-'"]


def left_over(name, text):
    return [f"{name}:{n}: {line.strip()[:80]}" for n, line in enumerate(text.split("\n"), 1)
            if LEFT_OVER.search(line) or MACHINE.search(line)]


def printed_elsewhere(name, text):
    """What a terminal refuses must not end a run: core/print.hpp alone knows how."""
    return [f"{name}:{n}: print by core::print" for n, line in enumerate(text.split("\n"), 1)
            if PRINTED.search(line) and not name.startswith("tests/")]


def opened_elsewhere(name, text):
    opened = OPENED["py" if name.endswith(".py") else "cpp"]
    return [f"{name}:{n}: open files by core/output/files.hpp, core/output/file.hpp or polybed.files" for n, line in enumerate(text.split("\n"), 1)
            if opened.search(line) and not SHIPPED.search(line) and name not in OPENERS and not name.startswith("tests/")]


def unformatted(paths):
    tool = shutil.which("clang-format-14") or shutil.which("clang-format")
    if tool is None:
        print("clang-format is not installed: formatting is not checked")
        return []
    run = subprocess.run([tool, "--dry-run", *map(str, paths)], capture_output=True, text=True)
    return sorted({line.split(":")[0].replace(str(ROOT) + "/", "") + ": not formatted"
                   for line in run.stderr.split("\n") if "warning:" in line or "error:" in line})


def laws_without_docs():
    page = (ROOT / "docs/theory/closures.md").read_text()
    names = re.findall(r'name = "(\w+)"', "".join(p.read_text() for p in (ROOT / "closures").glob("*.hpp")))
    return [f"docs/theory/closures.md does not mention the law {n}" for n in names if f"`{n}`" not in page]


def self_test():
    assert too_long("a", "x\n" * 401) and not too_long("a", "x\n" * 400)
    assert ill_named('rule("a")') and not ill_named("docs/a-b_c.md") and not ill_named(".ci/run")
    assert left_over("a", "int x;  // TO" + "DO later") and left_over("a", 'open("/ro' + 'ot/x")')
    assert not left_over("a", "a method, and a/work/b")
    assert printed_elsewhere("core/a.cpp", 'fmt::print(stderr, "a")') and not printed_elsewhere("core/a.cpp", 'core::print("a")')
    assert opened_elsewhere("core/a.cpp", "std::ifstream file(path);") and opened_elsewhere("python/polybed/a.py", "with open(path) as file:")
    assert opened_elsewhere("python/polybed/a.py", "path.read_text()") and opened_elsewhere("app/a.cpp", "  ::open(path, O_RDONLY)")
    assert not opened_elsewhere("python/polybed/a.py", 'with opened(path) as file, open(other, "w") as copy:')


if __name__ == "__main__":
    self_test()
    code = tracked(".hpp", ".cpp")
    problems = [problem for path in tracked("") for problem in ill_named(str(path.relative_to(ROOT)))]
    for path in code:
        problems += printed_elsewhere(str(path.relative_to(ROOT)), path.read_text())
    for path in code + [path for path in tracked(".py") if path.is_relative_to(ROOT / "python/polybed")]:
        problems += opened_elsewhere(str(path.relative_to(ROOT)), path.read_text())
    for path in code + tracked(".py", ".cmake", "CMakeLists.txt"):
        problems += too_long(str(path.relative_to(ROOT)), path.read_text())
    for path in code + tracked(".py", ".md", ".cmake", "CMakeLists.txt", "polybed", ".toml"):
        problems += left_over(str(path.relative_to(ROOT)), path.read_text())
    problems += unformatted(code) + laws_without_docs()
    sys.exit(report(problems, "habits"))
