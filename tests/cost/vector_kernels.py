#!/usr/bin/python3
"""Whether kernels are inlined whole: the parts of core::in_vectors for wide vectors call no loop over rows.

    tests/cost/vector_kernels.py LIBRARY...

A loop that is called, not inlined, runs at the least width of vectors: the same bits, at half the speed.
"""
import re
import subprocess
import sys


def loops_called(library):
    """Wide kernels of a library, and what loops they call."""
    text = subprocess.run(["objdump", "-dr", "-C", "--no-show-raw-insn", library], check=True, capture_output=True,
                          text=True).stdout
    kernels, kernel, called = 0, None, []
    for line in text.splitlines():
        if head := re.match(r"[0-9a-f]+ <(.*)>:$", line):
            kernel = head[1] if re.search(r"InVectors<.*::avx(2|512)", head[1]) else None
            kernels += kernel is not None
        elif kernel and "for_each_row<" in line and re.search(r"\bcall\b|R_X86_64_PLT32", line):
            called.append(f"{kernel[:160]}\n  calls {line.strip()[:200]}")
    return kernels, called


if __name__ == "__main__":
    for name in sys.argv[1:]:
        found, calls = loops_called(name)
        print(f"{name}: {found} kernels for wide vectors, {len(calls)} calls of loops", *calls[:5], sep="\n")
        if calls or not found:
            sys.exit(1)
