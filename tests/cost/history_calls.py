#!/usr/bin/python3
"""How often ranks wait for each other to write a row of history.csv, counted on 2 ranks of either model: the same run with few
rows and with many.

    history_calls.py POLYBED MPI_COUNTS_LIBRARY"""
import os
import pathlib
import subprocess
import sys
import tempfile

TESTS = pathlib.Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TESTS), str(TESTS / "cli")]
import open_mpi  # noqa: E402
from program import small_bed  # noqa: E402

CASE = small_bed("2 ms") + """[tfm]
integrator = "explicit"
fixed_step = "0.1 ms"
[dem]
fixed_step = "5 us"
[output]
every = 1
checkpoint_every = 1
"""
FEW, MANY = "1 ms", "0.1 ms"
# Greatest values of all ranks, their sums, whether a law is broken, and whether the first could write the row; the fields of
# the continuum are evaluated first, and ranks agree on whether they can be.
MOST = {"tfm": 5, "dem": 4}


def run(polybed, library, model, every):
    """Rows of the history and collective calls of the first rank."""
    with tempfile.TemporaryDirectory() as folder:
        case = pathlib.Path(folder, "case.toml")
        case.write_text(CASE)
        settings = os.environ | open_mpi.SETTINGS | open_mpi.MORE_THAN_CORES | {"MPI_COUNTS": f"{folder}/counts"}
        preloaded = ":".join(filter(None, [os.environ.get("LD_PRELOAD"), library]))
        subprocess.run(["mpirun", "-q", "-n", "2", "-x", "MPI_COUNTS", "-x", f"LD_PRELOAD={preloaded}", polybed, model, case,
                        "--quiet", "--no-picture", "--set", f"output.history_every={every}", "-o", f"{folder}/run"],
                       env=settings, check=True, stdout=subprocess.DEVNULL)
        rows = len(pathlib.Path(folder, "run/history.csv").read_text().splitlines()) - 1
        return rows, int(pathlib.Path(folder, "counts.0").read_text().split()[2])


def main():
    polybed, library = map(os.path.abspath, sys.argv[1:3])
    failed = []
    for model in ("tfm", "dem"):
        (few, before), (many, after) = (run(polybed, library, model, every) for every in (FEW, MANY))
        calls = (after - before) / (many - few)
        print(f"{model}: {calls:g} collective calls for a row of the history, measured over {many - few} rows")
        if many <= few or calls > MOST[model]:
            failed.append(f"{model}: more than {MOST[model]} collective calls for a row of the history")
    sys.exit("; ".join(failed) or 0)


if __name__ == "__main__":
    main()
