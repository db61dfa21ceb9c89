#!/usr/bin/python3
"""Every #include goes down the layers, each library is seen where it is wrapped alone, and a source includes what it uses of
the standard library and of fmt, itself or through a header of the program: sources are compiled several at a time,
where another's include would do. A folder reads its own table of the case and what both models share, not the table of the
other model. Its namespace is the folder's."""
import functools
import re
import sys

from sources import ROOT, report, tracked

MAY_USE = {
    "closures": {"closures"},
    "core": {"core"},
    "relevance": {"relevance", "core", "closures"},
    "fluid": {"fluid", "relevance", "core", "closures"},
    "measures": {"measures", "fluid", "relevance", "core", "closures"},
    "tfm": {"tfm", "measures", "fluid", "relevance", "core", "closures"},
    "dem": {"dem", "measures", "fluid", "relevance", "core", "closures"},
    "multiscale": {"multiscale", "tfm", "dem", "measures", "fluid", "relevance", "core", "closures"},
    "app": {"app", "multiscale", "tfm", "dem", "measures", "fluid", "relevance", "core", "closures"},
}
BELOW_ALL = "core/vectors.hpp"  # itself without an include of ours
# header -> the only files that may include it
LIBRARIES = {
    r"(arkode|ida|nvector|sundials|sunlinsol|sunmatrix)/": r"core/numerics/integrator(_\w+)?\.[ch]pp",
    r"_?HYPRE": r"core/numerics/(linear_solver\w*\.cpp|hypre_rows\.[ch]pp)",
    r"hdf5": r"core/output/((file|blocks)\.cpp|hdf5\.hpp)",
    r"lzma\.h": r"core/output/files\.cpp",
    r"toml\+\+/": r"core/case/(file\.cpp|override\.[ch]pp|values\.[ch]pp)",
    r"CLI/": r"app/commands\.hpp",
    r"nlohmann/json\.hpp": r".*\.cpp",
    r"nlohmann/json_fwd\.hpp": r"core/output/json\.hpp",
    r"mpi\.h": r"(core/numerics/mpi\.hpp|app/main\.cpp)",
    r"core/numerics/mpi\.hpp": r"core/(output/blocks\.cpp|numerics/(exact_sum\.hpp|(ranks|reduction|mpi_start|blocks|halo|messages|linear_solver|hypre_rows|integrator_vector|integrator_sundials|whole_column)\.cpp))",
}
# folder -> the table of the case that it may not read; setting a key of it is no reading
OTHERS_TABLE = {"tfm": "dem", "relevance": "(dem|tfm)", "fluid": "(dem|tfm)", "measures": "(dem|tfm)", "dem": "tfm"}
CLOSURES_SEE = re.compile(r"^(closures/|core/vectors\.hpp$|Eigen/|[a-z_]+$)")  # ours, widths of vectors, Eigen, the standard library

# header -> what tells that a source uses it
USES = {
    "algorithm": r"std::(sort|clamp|copy|fill|transform|(max|min)_element|(any|all|none)_of|(find|count)_if|ranges::\w+)\b",
    "array": r"std::array\b",
    "cmath": r"std::(sqrt|cbrt|pow|exp|log|log10|abs|isfinite|isnan|sin|cos|floor|ceil|hypot)\b",
    "cstdint": r"std::u?int(8|16|32|64)_t\b",
    "filesystem": r"std::filesystem\b",
    "functional": r"std::(function|plus|minus|less|greater)\b",
    "limits": r"std::numeric_limits\b",
    "map": r"std::(multi)?map\b",
    "memory": r"std::((unique|shared|weak)_ptr|make_(unique|shared))\b",
    "numbers": r"std::numbers\b",
    "optional": r"std::(optional|nullopt)\b",
    "span": r"std::span\b",
    "stdexcept": r"std::(runtime_error|logic_error|invalid_argument|out_of_range)\b",
    "string": r"std::(string|to_string)\b",
    "string_view": r"std::string_view\b",
    "variant": r"std::(variant|visit|get_if|holds_alternative)\b",
    "vector": r"std::vector\b",
    "nlohmann/json.hpp": r"\b(core::)?Json(::\w+\(|\(|\{| \w+( =|;|,))",
    "fmt/format.h": r"fmt::(format|print|format_to|join)\b",
}


@functools.cache
def includes(name):
    """Headers that a file of the program includes; none if it is none."""
    path = ROOT / name
    return frozenset(re.findall(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', path.read_text(), re.M)) if path.is_file() else frozenset()


def seen_from(headers):
    """These headers and all that they include."""
    seen, ahead = set(), set(headers)
    while ahead:
        header = ahead.pop()
        seen.add(header)
        ahead |= includes(header) - seen
    return seen


def not_included(name, text, headers):
    """Headers that a text uses and does not see. :param headers: what it includes"""
    code, seen = re.sub(r"//.*", "", text), seen_from(headers)
    return [f"{name}: uses <{header}> without including it" for header, use in USES.items()
            if header not in seen and re.search(use, code)]


def foreign_keys(name, text):
    """Reads of a table of the case that belongs to another model."""
    layer = name.split("/")[0]
    if layer not in OTHERS_TABLE:
        return []
    read = re.compile(rf"\.{OTHERS_TABLE[layer]}\b(?!\.\w+ = )")
    literal_or_comment = re.compile(r'"(?:[^"\\]|\\.)*"|//.*')
    return [f"{name}:{number}: reads a table of the case that belongs to another model" for number, line in
            enumerate(text.split("\n"), 1) if not line.lstrip().startswith("#") and read.search(literal_or_comment.sub("", line))]


def foreign_namespace(name, text):
    """A file's names are in the namespace of its folder. What it declares of others comes first."""
    layer, opened = name.split("/")[0], re.findall(r"^namespace polybed::(\w+)[\w:]* \{$", text, re.M)
    if layer not in MAY_USE or not opened or opened[-1] == layer:
        return []
    return [f"{name}: the namespace polybed::{opened[-1]} is not that of its folder"]


def sees(source, folder):
    """Headers of a folder on the path of a source: a run of one model does not pass through the other."""
    return [f"{source} sees {header}" for header in sorted(seen_from({source})) if header.startswith(folder + "/")]


def problems_of(name, text):
    found = foreign_keys(name, text) + foreign_namespace(name, text)
    layer = name.split("/")[0]
    for number, line in enumerate(text.split("\n"), 1):
        match = re.match(r'\s*#\s*include\s*[<"]([^>"]+)[>"]', line)
        if not match or layer not in MAY_USE:
            continue
        header, where = match.group(1), f"{name}:{number}: "
        target = header.split("/")[0]
        if target in MAY_USE and target not in MAY_USE[layer] and header != BELOW_ALL:
            found.append(where + f"{layer} may not use {target} ({header})")
        if name == BELOW_ALL and target in MAY_USE:
            found.append(where + "this header includes none of ours, since closures include it")
        for pattern, allowed in LIBRARIES.items():
            if re.match(pattern, header) and not re.fullmatch(allowed, name):
                found.append(where + f"{header} belongs in {allowed} alone")
        if layer == "closures" and not CLOSURES_SEE.match(header):
            found.append(where + f"closures sees the standard library and Eigen alone, not {header}")
    return found


def self_test():
    """The check must be able to fail."""
    assert problems_of("closures/a.hpp", '#include "core/error.hpp"')
    assert problems_of("core/a.hpp", '#include "closures/drag.hpp"')
    assert problems_of(BELOW_ALL, '#include "core/error.hpp"')
    assert problems_of("tfm/a.cpp", "#include <hdf5.h>")
    assert problems_of("dem/a.cpp", '#include "tfm/model.hpp"') and problems_of("tfm/a.cpp", '#include "dem/model.hpp"')
    assert problems_of("core/numerics/run.cpp", "#include <ida/ida.h>")
    assert problems_of("tfm/a.cpp", "a = scene.dem.friction;") and problems_of("dem/a.cpp", "const auto& t = scene.tfm;")
    assert problems_of("relevance/a.cpp", "scene.dem.gap = scene.dem.skin;")
    assert not problems_of("relevance/a.cpp", 'scene.dem.gap = 1;  // scene.tfm.rtol\na = "case.dem.x";')
    assert not problems_of("tfm/a.cpp", '#include "fluid/pressure.hpp"\n#include <vector>')
    assert problems_of("app/a.cpp", "namespace polybed::multiscale {\n")
    assert not problems_of("app/a.cpp", "namespace polybed::tfm {\n}\nnamespace polybed::app {\n")
    assert not_included("core/a.cpp", "std::vector<int> a;", {"map"})
    assert sees("app/dem.cpp", "dem") and not sees("dem/model.cpp", "tfm")
    assert not not_included("core/a.cpp", "std::vector<int> a;  // no std::map", {"core/case/scene.hpp"})


if __name__ == "__main__":
    self_test()
    problems = []
    for path in tracked(".hpp", ".cpp"):
        name, text = str(path.relative_to(ROOT)), path.read_text()
        problems += problems_of(name, text)
        if name.split("/")[0] in MAY_USE:
            problems += not_included(name, text, includes(name))
    sys.exit(report(problems + sees("app/tfm.cpp", "dem") + sees("app/dem.cpp", "tfm"), "includes"))
