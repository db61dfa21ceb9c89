#!/usr/bin/python3
"""polybed's resolved flow and Palabos through the same boxes: site updates a second of one core, in turn.

    lbm_peers.py LBM_BENCHMARK [EDGE]

Both programs move D3Q19 populations through a periodic cube of EDGE (96) sites, empty or with spheres of about ten sites, in single and
double precision, walls half-way (Palabos) or interpolated (polybed), a force on each site. That they solve one problem is seen by the
drag on a sphere of a simple cubic array with half-way walls. Palabos: Debian's package libplb-dev, compiled with -O3 as polybed is. Ends
with 2 where it is not installed.
"""
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
# One of its headers for nested grids, which nothing here uses, does not compile with g++ 12: its guard is set.
FLAGS = ["-O3", "-w", "-fpermissive", "-DPLB_MPI_PARALLEL", "-DCOARSE_GRID_PROCESSORS_3D_HH", "-I/usr/include/eigen3",
         "-I/usr/include/palabos"]


def palabos(folder, precision, edge):
    program = f"{folder}/flow-{precision}"
    subprocess.run(["mpicxx", *FLAGS, f"-DPRECISION={precision}", "-o", program, HERE / "palabos_flow.cpp", "-lplb"], check=True)
    lines = subprocess.run([program, edge], check=True, capture_output=True, text=True).stdout.split("\n")
    return {name: float(value) for name, value in (line.split() for line in lines if line)}


def main():
    if not pathlib.Path("/usr/include/palabos/palabos3D.h").exists():
        print("not installed: Palabos; apt-get install --no-install-recommends libplb-dev", file=sys.stderr)
        sys.exit(2)
    edge = sys.argv[2] if len(sys.argv) > 2 else "96"
    own = subprocess.run([sys.argv[1], edge], check=True, capture_output=True, text=True).stdout
    rates = {name.strip(): float(rate) for name, rate in re.findall(r"(.+?) +([0-9.]+) million", own)}
    with tempfile.TemporaryDirectory() as folder:
        peer = {precision: palabos(folder, precision, edge) for precision in ("float", "double")}
    print(f"{edge}^3 sites, million updates a second        polybed  Palabos  times")
    for name, precision, solids in (("no spheres, single", "float", "0"), ("voidage 0.9, single", "float", "0.1"),
                                    ("voidage 0.5, single", "float", "0.5"), ("voidage 0.5, double", "double", "0.5")):
        other = 1e-6 * peer[precision][solids]
        print(f"{name:42} {rates[name]:8.1f} {other:8.1f} {rates[name] / other:6.1f}")
    drag = float(re.search(r"half-way walls: ([0-9.]+)", own)[1])
    print(f"drag on a sphere of a simple cubic array: {drag:.3f}, Palabos {peer['double']['drag']:.3f}; tabulated 4.292")


if __name__ == "__main__":
    main()
