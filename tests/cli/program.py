"""The program under test as its user meets it: a command line, a code at the end, and files."""
import json
import lzma
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from concurrent.futures import ThreadPoolExecutor

import h5py
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests"))
import open_mpi  # noqa: E402

CASE = ROOT / "cases/matsuura-akehata/case.toml"
PROGRAM = None  # set by main
LONGEST = 60  # s; far beyond any of these commands, so that a program that hangs is told

DONE, WRONG_CASE, NUMBERS, FILE, STOPPED = 0, 2, 3, 4, 130

# A coarse grid: a step takes about 1 ms. Checkpoints and outputs have intervals of their own, so that they do not
# move with the end of the run.
SMALL = ["--set", "column.cells=[6,60]", "--set", "output.every=0.1", "--set", "output.history_every=0.01",
         "--set", "output.checkpoint_every=0.1"]

# Species of a case of few particles.
TWO_SIZES = """[[species]]
name = "fine"
diameter = "0.8 mm"
density = 1395
[[species]]
name = "coarse"
diameter = "2 mm"
density = 1170
"""
TWO_IN_WATER = """[fluid]
name = "water"
density = 999
viscosity = "1.14e-3 Pa s"
""" + TWO_SIZES
TWO_DRY = """[fluid]
name = "none"
[[species]]
name = "fine"
diameter = "1 mm"
density = 2500
[[species]]
name = "coarse"
diameter = "1.5 mm"
density = 2000
"""
# A filter of two media in layers, at its backwash.
FILTER = """[column]
size = ["50 mm", "1050 mm"]
cells = [1, 105]
sides = "periodic"
outlet = "open"
[fluid]
name = "water"
temperature = "10 degC"
[[species]]
name = "sand"
diameter = "0.6 mm"
density = 2650
[[species]]
name = "anthracite"
diameter = "1.2 mm"
density = 1450
[bed]
solids_fraction = 0.57
[[layer]]
species = "sand"
height = "250 mm"
[[layer]]
species = "anthracite"
height = "300 mm"
solids_fraction = 0.52
[inlet]
superficial_velocity = "40 m/h"
[effects]
drag = "wen_yu"
partition = "brinkman_oseen"
solids_stress = "frictional"
others = "none"
[run]
until = "120 s"
"""


def small_bed(until):
    """A case that both models run: 4 x 24 cells, a few hundred particles. until: its end, with its unit."""
    return """[column]
size = ["10 mm", "40 mm"]
cells = [4, 24]
sides = "periodic"
""" + TWO_IN_WATER + f"""[bed]
volume_share = [0.8, 0.2]
static_height = "12 mm"
solids_fraction = 0.6
start_solids_fraction = 0.4
[inlet]
superficial_velocity = "20 mm/s"
[effects]
others = "none"
drag = "cello"
solids_stress = "frictional"
contact = "hertz_mindlin"
[run]
until = "{until}"
"""


def falling(column, particles, solids, history):
    """Dry spheres of two sizes, so many of each, that fall from a solids fraction. column: size and cells"""
    return f"""[column]
{column}
""" + TWO_DRY + f"""[bed]
particles = {particles}
solids_fraction = 0.6
start = "mixed"
start_solids_fraction = {solids}
[effects]
others = "none"
contact = "hertz_mindlin"
[dem]
friction = 0.4
[run]
until = "20 ms"
[output]
every = "5 ms"
history_every = "{history}"
checkpoint_every = "5 ms"
"""


def rising(column, particles, solids, effects, end):
    """Spheres of two sizes in rising water. effects: more of them; end: tables [run] and [output]"""
    return f"""[column]
{column}
sides = "periodic"
""" + TWO_IN_WATER + f"""[bed]
particles = {particles}
solids_fraction = 0.6
start = "mixed"
start_solids_fraction = {solids}
[inlet]
superficial_velocity = "20 mm/s"
[effects]
others = "none"
drag = "cello"
{effects}contact = "hertz_mindlin"
[dem]
youngs_modulus = "0.3 MPa"
{end}"""


def environment(scratch):
    """One rank needs neither network nor daemon: without them MPI starts in a sixth of the time."""
    return {"POLYBED_TYPED": "polybed"} | os.environ | open_mpi.ONE_PROCESS | {"OMPI_MCA_orte_tmpdir_base": scratch}


def command(words, picture=False):
    """A run draws no picture unless asked to: that takes ten times as long as the runs here."""
    plain = picture or "--no-picture" in words or not words or words[0] not in ("tfm", "dem")
    return [PROGRAM, *map(str, words), *([] if plain else ["--no-picture"])]


def run(*words, picture=False, **options):
    """The finished command; its texts are decoded strictly, since the program speaks UTF-8."""
    options = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "encoding": "utf-8", "timeout": LONGEST, **options}
    with tempfile.TemporaryDirectory() as scratch:
        return subprocess.run(command(words, picture), env=environment(scratch), **options)


def peak_memory(*words):
    """Bytes that a command held at most; it has to end well."""
    with tempfile.TemporaryDirectory() as scratch:
        process = subprocess.Popen(command(words), env=environment(scratch), stdout=subprocess.DEVNULL)
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    assert process.returncode == DONE, (words, process.returncode)
    return used.ru_maxrss * 1024


def run_all(commands, **options):
    """Several commands side by side; their answers in the order given."""
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        return list(pool.map(lambda words: run(*words, **options), commands))


def run_on_ranks(ranks, *words):
    """The finished command on ranks of mpirun, of which those that wait let the others compute."""
    settings = os.environ | open_mpi.SETTINGS | open_mpi.MORE_THAN_CORES
    with tempfile.TemporaryDirectory() as scratch:
        return subprocess.run(["mpirun", "-q", "-n", str(ranks), *command(words)], env=settings | {"OMPI_MCA_orte_tmpdir_base": scratch},
                              capture_output=True, encoding="utf-8", timeout=300)


def wait_until(process, condition):
    """Waits for a state of a running program; fails if the program ends first."""
    for _ in range(LONGEST * 500):
        if condition():
            return
        if process.poll() is not None:
            raise AssertionError(f"ended early with {process.returncode}: {process.communicate()}")
        time.sleep(0.002)
    process.kill()
    raise AssertionError("the program did not get there")


def strict_json(text):
    def refuse(name):
        raise AssertionError(f"{name} in JSON")
    return json.loads(text, parse_constant=refuse)


def datasets(path):
    """Every dataset of an HDF5 file by its path, through external links too."""
    found = {}

    def walk(group, prefix):
        for name in group:
            item = group[name]
            walk(item, f"{prefix}/{name}") if isinstance(item, h5py.Group) else found.update({f"{prefix}/{name}": item[()]})
    with h5py.File(path) as file:
        walk(file, "")
    return found


def same_bits(one, other):
    """Names of the datasets in which two HDF5 files differ, or that only one has."""
    a, b = datasets(one), datasets(other)
    return [n for n in sorted(set(a) | set(b))
            if n not in a or n not in b or np.asarray(a[n]).tobytes() != np.asarray(b[n]).tobytes()]


def lasting(directory):
    """The record of a run without what the clock says: a run in two parts and the run in one have the same."""
    record = strict_json((directory / "run.json").read_text())
    for name in ("cpu_s", "wall_s", "cpu_s_per_simulated_s", "timers", "prediction"):
        record.pop(name, None)
    record["card"].pop("time_s")
    record["card"]["lines"] = [line for line in record["card"]["lines"] if not line.startswith("time ")]
    return record


MARK = b"polybed complete"  # begins the seal behind a checkpoint; its length and checksum follow
SEAL = len(MARK) + 16


def unseal(path):
    """Takes the seal from a checkpoint."""
    os.truncate(path, path.stat().st_size - SEAL)


def seal(path):
    """Puts the seal of its content behind an HDF5 file. XZ has the same checksum, before its index, the length of which is in the footer."""
    content = path.read_bytes()
    stream = lzma.compress(content, check=lzma.CHECK_CRC64, preset=0)
    end = len(stream) - 12 - 4 * (1 + int.from_bytes(stream[-8:-4], "little"))
    path.write_bytes(content + MARK + len(content).to_bytes(8, "little") + stream[end - 8:end])


def history(directory):
    """Columns of history.csv by name; an empty cell (nothing to measure) is None."""
    text = (directory / "history.csv").read_text()
    rows = [line.split(",") for line in text.splitlines()]
    assert all(len(row) == len(rows[0]) for row in rows) and text.endswith("\n"), "a row is not whole"
    return {name: [float(row[n]) if row[n] else None for row in rows[1:]] for n, name in enumerate(rows[0])}


class Scratch(unittest.TestCase):
    """A test with a folder of its own, in which it works."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, name, content):
        path = self.folder / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    def start(self, *words):
        return subprocess.Popen(command(words), stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                encoding="utf-8", env=environment(tempfile.mkdtemp(dir=self.folder)))

    def ends(self, code, *words, **options):
        done = run(*words, **options)
        self.assertEqual(done.returncode, code, f"{words}\n{(done.stdout or '')[-500:]}\n{done.stderr[-500:]}")
        return done

    def on_ranks(self, ranks, *words, code=DONE):
        done = run_on_ranks(ranks, *words)
        self.assertEqual(done.returncode, code, f"{ranks} ranks: {words}\n{done.stdout[-500:]}\n{done.stderr[-1500:]}")
        return done

    def interrupted(self, directory, *words, clock):
        """A run into a directory, ended by Ctrl-C once it has a checkpoint; its record. The user is told of the checkpoint,
        and it is of the time at which the run was stopped. :param clock: the checkpoint's name of its time"""
        running = self.start(*words, "-o", directory)
        wait_until(running, (directory / "checkpoint.h5").exists)
        running.send_signal(signal.SIGINT)
        told = running.communicate(timeout=LONGEST)
        self.assertEqual(running.returncode, STOPPED, told)
        self.assertIn("checkpoint", told[1])
        record = strict_json((directory / "run.json").read_text())
        self.assertEqual(record["state"], "stopped by the user")
        with h5py.File(directory / "checkpoint.h5") as checkpoint:
            self.assertEqual(checkpoint[f"numbers/{clock}"][()], record["time_s"])
        return record

    def has_no_nan(self, directory, files=("fields.h5", "profiles.h5", "checkpoint.h5")):
        """All numbers of these files of a run directory and of its history are finite."""
        for name in files:
            for path, values in datasets(directory / name).items():
                if np.asarray(values).dtype.kind == "f":
                    self.assertTrue(np.isfinite(values).all(), f"{name}{path}")
        for column, values in history(directory).items():
            self.assertTrue(all(v is None or np.isfinite(v) for v in values), column)


def main():
    global PROGRAM
    PROGRAM = os.path.abspath(sys.argv.pop(1))
    signal.signal(signal.SIGINT, signal.default_int_handler)  # what is ignored here would be ignored by the program
    sys.modules["program"].PROGRAM = PROGRAM
    unittest.main(module="__main__")
