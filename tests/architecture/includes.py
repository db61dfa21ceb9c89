#!/usr/bin/python3
"""Every #include goes down the layers, and each library is seen where it is wrapped alone."""
import re
import sys

from sources import ROOT, report, tracked

MAY_USE = {
    "closures": {"closures"},
    "core": {"core"},
    "fluid": {"fluid", "core", "closures"},
    "tfm": {"tfm", "fluid", "core", "closures"},
    "dem": {"dem", "fluid", "core", "closures"},
    "multiscale": {"multiscale", "tfm", "dem", "fluid", "core", "closures"},
}
# header -> the only files that may include it
LIBRARIES = {
    r"(arkode|ida|nvector|sundials|sunlinsol|sunmatrix)/": r"core/integrator(_\w+)?\.[ch]pp",
    r"_?HYPRE": r"core/(linear_solver\w*\.cpp|hypre_rows\.[ch]pp)",
    r"hdf5": r"core/output_((file|blocks)\.cpp|hdf5\.hpp)",
    r"toml\+\+/": r"core/case_(file\.cpp|override\.[ch]pp|values\.[ch]pp)",
    r"CLI/": r"multiscale/command_line/commands\.hpp",
    r"mpi\.h": r"(core/mpi\.hpp|multiscale/command_line/mpi_session\.hpp)",
    r"core/mpi\.hpp": r"core/(ranks|blocks|halo|messages|output_blocks|linear_solver|hypre_rows|integrator_vector)\.cpp",
}
CLOSURES_SEE = re.compile(r"^(closures/|Eigen/|[a-z_]+$)")  # ours, Eigen, the standard library


def problems_of(name, text):
    found = []
    layer = name.split("/")[0]
    for number, line in enumerate(text.split("\n"), 1):
        match = re.match(r'\s*#\s*include\s*[<"]([^>"]+)[>"]', line)
        if not match or layer not in MAY_USE:
            continue
        header, where = match.group(1), f"{name}:{number}: "
        target = header.split("/")[0]
        if target in MAY_USE and target not in MAY_USE[layer]:
            found.append(where + f"{layer} may not use {target} ({header})")
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
    assert problems_of("tfm/a.cpp", "#include <hdf5.h>")
    assert problems_of("dem/a.cpp", '#include "tfm/model.hpp"') and problems_of("tfm/a.cpp", '#include "dem/model.hpp"')
    assert problems_of("core/run.cpp", "#include <ida/ida.h>")
    assert not problems_of("tfm/a.cpp", '#include "fluid/pressure.hpp"\n#include <vector>')


if __name__ == "__main__":
    self_test()
    problems = []
    for path in tracked(".hpp", ".cpp"):
        problems += problems_of(str(path.relative_to(ROOT)), path.read_text())
    sys.exit(report(problems, "includes"))
