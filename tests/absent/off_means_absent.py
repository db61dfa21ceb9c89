#!/usr/bin/python3
"""An effect that is off costs nothing: every kernel of a run takes the same instructions as in a program that was built
without the effect, and the run has the same lists. off_means_absent.py WHOLE BARE: two programs of tests/absent.

The instructions are callgrind's self counts, function by function; they repeat exactly. Totals do not: lazy binding
moves them. A kernel that asks a flag is built in, and has to be told apart, or the test says nothing."""
import os
import re
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

OURS = re.compile(r"\bpolybed::")
# What makes effects and lists them, once: here the lists themselves differ.
REGISTRIES = re.compile(r"SideForces::SideForces|ParticleForces::ParticleForces|CaseReader::read|make_pair_laws|make_effects|makers::|"
                        r"for_each_called|roles\(\)|rules(_of_keys)?\(|menu_of|effects\(\)|PairLaws::|relevance::(?!FluidConstants)|"
                        r"core::(Rule|Role|Law|refuse|law_of|Scene::law|is_off|is_law|WrongKeys|Broken)|_GLOBAL__sub_I")
CONTROL = "polybed::absent::control_kernel(int)"
LEAST = 1000  # instructions: below it a function is no kernel
# Share by which the counts of one function may differ: a loop over an array begins by what it lies on in memory, which moves
# with what was allocated before. A branch in a loop of a hundred instructions is ten times as much.
ALIGNMENT = 1e-3


def self_counts(path):
    """Self instructions of each function in a file of callgrind's, names spelled out or by number."""
    counts, names, function = {}, {}, None
    calls = False
    for line in open(path):
        if match := re.match(r"fn=\((\d+)\)(?: (.*))?", line):
            number, name = match.groups()
            names.setdefault(number, name)
            function = names[number]
        elif match := re.match(r"cfn=\((\d+)\)(?: (.*))?", line):
            names.setdefault(*match.groups())
        elif line.startswith("calls="):
            calls = True  # the next line is what was called: not the function's own
        elif re.match(r"[+\-*\d]", line):
            if not calls and function:
                counts[function] = counts.get(function, 0) + int(line.split()[1])
            calls = False
    return counts


def counted(program, folder, name):
    out = os.path.join(folder, name)
    environment = dict(os.environ, OMPI_MCA_btl="self", OMPI_MCA_pml="ob1", OMPI_MCA_ess_singleton_isolated="1",
                       OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    done = subprocess.run(["valgrind", "--tool=callgrind", f"--callgrind-out-file={out}", program], text=True,
                          capture_output=True, env=environment)
    assert done.returncode == 0, done.stderr[-2000:]
    return done.stdout, {f: n for f, n in self_counts(out).items() if OURS.search(f)}


def differences(one, other):
    """Functions with other counts, or that only one program ran."""
    return {f: (one.get(f, 0), other.get(f, 0)) for f in set(one) | set(other)
            if (most := max(one.get(f, 0), other.get(f, 0))) >= LEAST and abs(one.get(f, 0) - other.get(f, 0)) > ALIGNMENT * most}


def main():
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(2) as pool:
        (text, whole), (bare_text, bare) = pool.map(lambda p: counted(*p), [
            (sys.argv[1], folder, "whole"), (sys.argv[2], folder, "bare")])
    assert text == bare_text, f"the lists differ:\n{text}\nwithout the effects:\n{bare_text}"
    assert int(re.search(r"contact steps (\d+)", text)[1]) > 0, "no particles met: the kernel of contacts did nothing"
    assert int(re.search(r"continuum steps (\d+)", text)[1]) > 0, "the continuum did nothing"
    assert any("tfm::" in f for f in whole), "no kernel of the continuum was counted"
    found = differences(whole, bare)
    assert found.pop(CONTROL, None), "the control, a kernel with a flag, was not told apart: the test sees nothing"
    kernels = {f: n for f, n in whole.items() if n >= LEAST and not REGISTRIES.search(f) and f != CONTROL}
    wrong = {f: n for f, n in found.items() if not REGISTRIES.search(f)}
    for function, (with_it, without) in sorted(wrong.items()):
        print(f"{function}: {with_it} instructions, {without} in the program without the effects")
    print(f"{len(kernels)} functions, {sum(kernels.values())} instructions of their own; {len(wrong)} differ")
    print(f"control: {whole[CONTROL]} with a flag that is off, {bare[CONTROL]} without it")
    assert len(kernels) > 20, "too few kernels were run"
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
