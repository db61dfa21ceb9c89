#!/usr/bin/python3
"""Scenes drawn over all keys of the case file, and files of runs with bytes turned and sealed again: what may not happen, happens?

Usage: random_scenes.py PROGRAM FIRST LAST [-j 2] [--mutants] [--keep DIR]

Scene n is the same on every machine. A small bed of either model gets some keys at random, each a value of its range, most of them near
its standard. It may be refused (2, each line with its place or the whole case), end (0) with all ledgers kept, or stop (3) at a limit that
its message names. With --mutants scene n is a run of a few steps, one dataset of its directory gets a number, a length or a type that does
not fit, and it is resumed, plotted and measured. Code 1 if anything else happened.
"""
import argparse
import ctypes.util
import ctypes
import json
import math
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import open_mpi  # noqa: E402

LONGEST = 40  # s of a command; it is asked to stop then, and given as long again to do so
# A stop that blames the scene by the name of a limit, which the message has to contain.
LIMITS = re.compile(r"overlap|time step|step size|packed|packing|shorter|energy|converge|too fast|maximum|no longer|limit|ledger|cannot")
PLACE = re.compile(r"case\.toml(:\d+:\d+)?: |^polybed: error: |--set|^ +|[a-z_]+\.[a-z_]+|memory|disk")
# Not drawn: files, records, what only other commands read, and the ends, which are drawn with the scene.
NOT_DRAWN = re.compile(r"^(title|run\.|output\.|resolve\.|calibrate\.|inversion\.|species\.name|chooser\.chosen|column\.(size|cells|shape)"
                       r"|\[|bed\.(volume_share|particles|static_height|layer)|fluid\.name|(jet|feed|layer|wall|contact_pair)\.)")
# Keys that few scenes can have.
NEEDS_MUCH = re.compile(r"column\.(ends|sides|depth|gravity_direction|closed)|dem\.(opening|shear_rate|normal_stiffness|fixed_step)|tfm\.fixed_step"
                        r"|fluid\.(density|viscosity|tait)|inlet\.flow_rate|species|bed\.start")


def log_uniform(rng, low, high):
    return math.exp(rng.uniform(math.log(low), math.log(high)))


def number(rng, key):
    """A value of a key's range: within a factor of 30 of its standard, or anything, or an end of the range."""
    ends = dict(re.findall(r"(at least|above|at most) ([-+.\de]+)", key["range"]))
    low, high = float(ends.get("at least", ends.get("above", 0))), float(ends.get("at most", 1e6))
    low = low or 1e-6
    found = re.match(r"[-+.\de]+", str(key.get("default") or ""))
    standard = float(found[0]) if found else None
    what = rng.random()
    if what < 0.1:
        return rng.choice([low, high, 0, -1])
    if standard and what < 0.8:
        value = standard * log_uniform(rng, 1 / 30, 30)
    elif low < 0:
        value = rng.uniform(max(low, -10), min(high, 10))
    else:
        value = log_uniform(rng, low, max(high, low))
    return min(max(value, low), high)


def value_of(rng, key):
    """The text of a random value of a key, as TOML."""
    kind = key["kind"]
    if " | " in key["range"]:
        return json.dumps(rng.choice([choice for choice in key["range"].split(" | ") if " " not in choice and ":" not in choice]))
    if kind.startswith("true"):
        return rng.choice(["true", "false"])
    if kind.startswith("list of numbers"):
        return "[" + ", ".join(f"{number(rng, key):.4g}" for _ in range(rng.choice([1, 2, 2, 3]))) + "]"
    if kind.startswith("number"):
        return f"{number(rng, key):.6g}"
    if kind.startswith("count"):
        return str(round(number(rng, key)))
    return None


def species(rng, n, size, gas):
    density = log_uniform(rng, 1050, 8000) if gas or rng.random() < 0.85 else rng.uniform(200, 990)
    text = f'[[species]]\nname = "s{n}"\ndensity = {density:.4g}\n'
    if rng.random() < 0.12:
        return text + f'distribution = "lognormal"\nmedian = {size:.4g}\ndeviation = {rng.uniform(0.05, 0.5):.3g}\nclasses = {rng.randint(1, 4)}\n'
    return text + f"diameter = {size:.4g}\n"


def scene(rng, keys, roles):
    """The text of a case and its model."""
    model = rng.choice(["tfm", "dem"])
    fluid = rng.choice(["water", "air", "own", "none"] if model == "dem" else ["water", "water", "air", "own"])
    gas = fluid in ("air", "none")
    three = rng.random() < (0.5 if model == "dem" else 0.25)
    shape = rng.choice(["box"] * 4 + (["cylinder"] if three else ["axisymmetric"]))
    size = log_uniform(rng, 5e-5, 5e-3)
    count = rng.choice([1, 1, 2, 2, 3])
    sizes = [size * log_uniform(rng, 1 / 2.5, 1) for _ in range(count)]
    across = rng.choice([6, 8, 10]) if model == "dem" else rng.choice([10, 30, 100, 400])
    width, height = across * size, across * size * rng.choice([2, 4, 8])
    cells_across = max(2, round(across / rng.choice([2, 2.5, 3]))) if model == "dem" else rng.choice([3, 6, 10, 16])
    if shape == "cylinder":
        cells_across = max(cells_across, 6)
    width_cells = [cells_across] * (2 if three else 1)
    lengths = [width, width] if three else [width]
    shares = [rng.random() + 0.05 for _ in range(count)]
    shares = [round(share / sum(shares), 3) for share in shares]
    shares[0] = round(1 - sum(shares[1:]), 3)
    velocity = log_uniform(rng, 1e-4, 3) if gas else log_uniform(rng, 1e-4, 0.3)
    rows = max(4, round(height / width * cells_across))
    column = [f"size = [{', '.join(f'{x:.5g}' for x in lengths + [height])}]",
              f"cells = [{', '.join(map(str, width_cells + [rows]))}]", f'shape = "{shape}"']
    bed = [f"volume_share = [{', '.join(f'{x:.3f}' for x in shares)}]",
           f"static_height = {height * rng.choice([0.1, 0.2, 0.4]):.5g}", f"solids_fraction = {rng.choice([0.58, 0.6, 0.62])}",
           f"start_solids_fraction = {rng.choice([0.3, 0.4, 0.5, 0.58])}"]
    tables = {"column": column, "bed": bed, "fluid": [f'name = "{fluid if fluid != "own" else "mine"}"'], "inlet": [],
              "run": [f"until = {log_uniform(rng, 1e-3, 0.5 if model == 'dem' else 4):.4g}"], "effects": []}
    if fluid in ("water", "air"):
        tables["fluid"].append(f"temperature = {rng.uniform(275, 312):.5g}")
    if fluid == "own":
        tables["fluid"] += [f"density = {log_uniform(rng, 1, 2000):.4g}", f"viscosity = {log_uniform(rng, 1e-5, 10):.4g}"]
    closed = fluid == "none" or rng.random() < 0.15
    if not closed:
        tables["inlet"].append(f"superficial_velocity = {velocity:.4g}")
    elif fluid != "none":
        column.append("closed = true")
    if rng.random() < 0.6:
        tables["effects"].append(f'others = "{rng.choice(["auto", "none"])}"')
    for role in rng.sample(roles, rng.choice([0, 1, 2, 4])):
        law = rng.choice(["none", "auto"] + [law["law"] for law in role["laws"] if ":" not in law["law"]])
        tables["effects"].append(f'{role["role"]} = "{law}"')
    for key in rng.sample(keys, rng.choice([0, 1, 2, 3, 6])):
        table, _, name = key["key"].rpartition(".")
        if table in ("tfm", "dem") and table != model or NEEDS_MUCH.match(key["key"]) and rng.random() < 0.7:
            continue
        value = value_of(rng, key)
        if value is not None and table in {**tables, "tfm": 0, "dem": 0, "chooser": 0}:
            lines = tables.setdefault(table, [])
            if not any(line.startswith(name + " ") for line in lines):
                lines.append(f"{name} = {value}")
    text = "".join(f"[{name}]\n" + "\n".join(lines) + "\n" for name, lines in tables.items() if lines)
    text += "".join(species(rng, n, s, gas) for n, s in enumerate(sizes))
    low, high = sorted(rng.uniform(0, width) for _ in range(2))
    corners = [f"[{x:.5g}]" if not three else f"[{x:.5g}, {x:.5g}]" for x in (low, high)]
    if not closed and rng.random() < 0.12:
        text += f"[[jet]]\nfrom = {corners[0]}\nto = {corners[1]}\nsuperficial_velocity = {velocity * rng.uniform(1, 20):.4g}\n"
    if (not closed or fluid == "none") and rng.random() < 0.12:
        text += (f'[[feed]]\nspecies = "s{rng.randrange(count)}"\nat = "{rng.choice(["bottom", "top", "left", "right"])}"\n'
                 f"superficial_velocity = {velocity / 20:.4g}\nvelocity = {velocity:.4g}\nfrom = {corners[0]}\nto = {corners[1]}\n")
    if rng.random() < 0.12:
        text += (f'[[discharge]]\nat = "{rng.choice(["bottom", "left", "right"])}"\nsuperficial_velocity = {velocity:.4g}\n'
                 f"from = {corners[0]}\nto = {corners[1]}\n")
    if fluid == "none" and rng.random() < 0.2:
        text += f"[[wall]]\nfrom = [0, {0.3 * height:.5g}]\nto = [{0.35 * width:.5g}, {0.1 * height:.5g}]\n"
    if rng.random() < 0.2:  # bed.start = "layered" by parts
        text = re.sub(r"(volume_share|static_height|start_solids_fraction) = .*\n", "", text).replace(
            "[bed]\n", '[bed]\nstart = "layered"\n')
        text += "".join(f'[[layer]]\nspecies = "s{n}"\nheight = {0.3 * height * share:.5g}\n' for n, share in enumerate(shares))
    if rng.random() < 0.3:
        text += walls(rng, shape, three, width, height, [width / cells_across, height / rows])
    elif fluid != "none" and rng.random() < 0.2 and "grad" not in text:
        text = text.replace("[column]\n", f"[column]\ngrading = {rng.uniform(1.01, 1.21):.4g}\ngraded_above = {height * rng.uniform(0.2, 0.8):.4g}\n")
    return text, model


def walls(rng, shape, three, width, height, cell):
    """Walls inside with a thickness, anywhere in the column, most of them thick enough for a fluid."""
    text, round_ones = "", shape != "box" or three and rng.random() < 0.3
    widest = 2 * width if shape == "axisymmetric" else width
    for _ in range(rng.choice([1, 1, 2, 4])):
        kind = rng.choice(["cylinder", "cone"] if round_ones else ["rod", "rod", "flat"])
        places = [[rng.uniform(0, widest), max(rng.uniform(0.1, 1) * height, 3 * cell[1] * rng.choice([0.5, 1, 1]))] for _ in range(2)]
        start, end = places[0], {"rod": places[0], "cylinder": [places[0][0], places[1][1]]}.get(kind, places[1])
        text += (f'[[wall]]\nshape = "{kind}"\nfrom = [{start[0]:.5g}, {start[1]:.5g}]\nto = [{end[0]:.5g}, {end[1]:.5g}]\n'
                 f"thickness = {max(cell) * rng.choice([0.5, 1.5, 2, 2.1, 2.1, 3]):.4g}\n")
    return text


def ended(program, words, folder, longest=LONGEST):
    """Code, screen and errors of a command; asked to stop once it takes too long."""
    process = subprocess.Popen([program, *words], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                               env=os.environ | open_mpi.ONE_PROCESS)
    try:
        out, err = process.communicate(timeout=longest)
    except subprocess.TimeoutExpired:
        process.terminate()
        try:
            out, err = process.communicate(timeout=longest)
        except subprocess.TimeoutExpired:
            process.kill()
            out, err = process.communicate()
            return "deaf", out, err
    return process.returncode, out, err


def strange_text(code, out, err):
    """What no command may print, or how it may not end."""
    text = (out + err).decode(errors="replace")
    if code not in (0, 2, 3, 4, 130, 143):
        return f"ended with {code}: {text[-300:]}"
    if "Traceback" in text or "HDF5-DIAG" in text or "terminate called" in text:
        return "raw error: " + text[-300:]
    if re.search(r"[\x00-\x08\x0b\x0c\x0e-\x1a\x7f]", text):
        return "control character"
    return None


def strange_files(directory):
    """What no run directory may contain."""
    def refuse(word):
        raise ValueError(f"{word} in run.json")
    record = json.loads((directory / "run.json").read_text(), parse_constant=refuse)
    if record["state"] == "running":
        return "run.json stays running"
    for kept in record["invariants"] if record["state"] == "done" else []:
        if not kept["held"] and not any(kept["name"] in warning for warning in record["warnings"]):
            return f"broken without a word: {kept}"
        if kept.get("judged", True) and kept["worst"] > 10 * kept["limit"]:
            return f"ten times beyond its limit: {kept}"
    history = directory / "history.csv"
    if history.exists() and re.search(r"\b(nan|inf)\b", history.read_text()):
        return "no number in history.csv"
    for path in directory.rglob("*.h5"):
        found = []

        def look(name, data):
            if isinstance(data, h5py.Dataset) and data.dtype.kind == "f" and not np.isfinite(data[...]).all():
                found.append(name)
        with h5py.File(path) as file:
            file.visititems(look)
        if found:
            return f"no number in {path.name}: {found[0]}"
    return None


def strange_scene(program, n, keys, roles, folder):
    """What is wrong with scene n, or None; and how it ended."""
    text, model = scene(random.Random(n), keys, roles)
    (folder / "case.toml").write_text(text)
    checked, out, err = ended(program, ["check", "case.toml"], folder)
    found = strange_text(checked, out, err)
    if found:
        return "check: " + found, "check"
    told_by_check = out.decode(errors="replace")
    told = re.search(rf"polybed {model} +([\d.e+-]+) s .* about ([^,]+) of computing", told_by_check)
    shorter = []
    if told:  # as long as some seconds of computing, by the forecast
        units = {"s": 1, "min": 60, "h": 3600, "days": 86400}
        cpu = sum(float(value) * units.get(unit, 1e9) for value, unit in re.findall(r"([\d.e+-]+) (\w+)", told[2]))
        shorter = ["--until", f"{float(told[1]) * min(1, 2 / max(cpu, 1e-3)):.4g}"]
    code, out, err = ended(program, [model, "case.toml", "-o", "run", "--no-picture", *shorter], folder)
    found = strange_text(code, out, err)
    if found or code == "deaf":
        return found or "deaf to TERM", str(code)
    words = err.decode(errors="replace")
    # A case without a law of contact is one of the continuum: check says nothing of particles.
    if code == 2 and checked == 0 and f"polybed {model} cannot" not in told_by_check and not re.search("memory|need a law of contact", words):
        return "check lets pass what is refused: " + words[-300:], "2"
    if code == 2 and not PLACE.search(words.rstrip().splitlines()[-1]):
        return "refused without a place: " + words[-300:], "2"
    if code == 3 and not LIMITS.search(words):
        return "stopped by no limit: " + words[-400:], "3"
    if code in (0, 3, 130, 143) and (folder / "run/run.json").exists():
        return strange_files(folder / "run"), str(code)
    return None, str(code)


def sealed(path):
    """Sets the seal of a checkpoint, its size and CRC-64, right again."""
    lzma = ctypes.CDLL(ctypes.util.find_library("lzma"))
    lzma.lzma_crc64.restype = ctypes.c_uint64
    lzma.lzma_crc64.argtypes = [ctypes.c_char_p, ctypes.c_size_t, ctypes.c_uint64]
    body = path.read_bytes()
    path.write_bytes(body + b"polybed complete" + len(body).to_bytes(8, "little") +
                     lzma.lzma_crc64(body, len(body), 0).to_bytes(8, "little"))


def changed(rng, path):
    """Turns one dataset or attribute of a file; says which and how."""
    seal = path.name.startswith("checkpoint")
    if seal:
        path.write_bytes(path.read_bytes()[:-32])
    with h5py.File(path, "r+") as file:
        names = []
        file.visititems(lambda name, data: names.append(name) if isinstance(data, h5py.Dataset) else None)
        name = rng.choice(sorted(names))
        data = file[name][()]
        how = rng.choice(["number", "length", "type", "gone", "group"])
        if how == "number" and file[name].dtype.kind in "fiu" and np.size(data):
            data = np.array(data)
            wrong = [np.nan, np.inf, -1, 1e300, 0] if data.dtype.kind == "f" else [-1, 0, 2**31 - 1] if data.dtype.kind == "i" else [0, 2**63]
            data.flat[rng.randrange(data.size)] = rng.choice(wrong)
            file[name][...] = data
        else:
            del file[name]
            if how == "length":
                file[name] = np.resize(np.array(data), max(1, np.size(data) + rng.choice([-1, 1, 5])))
            elif how == "type":
                file[name] = "text"
            elif how == "group":
                file.create_group(name)
    if seal:
        sealed(path)
    return f"{path.name} {name} {how}"


def strange_mutant(program, n, folder):
    rng = random.Random(n)
    model = ["tfm", "dem"][n % 2]
    case = pathlib.Path(__file__).resolve().parents[2] / "cases/quarter-b/case.toml"
    settings = [word for setting in ("column.cells=[4,16]", "column.size=[0.01,0.06]", "bed.particles=[300,10]") for word in ("--set", setting)]
    until = "0.02 s" if model == "dem" else "0.1 s"
    code, _, err = ended(program, [model, str(case), "-o", "run", "--no-picture", "--until", until, *settings], folder)
    if code != 0:
        return f"the run to be changed ended with {code}: {err.decode()[-300:]}", "run"
    files = sorted(p for p in (folder / "run").rglob("*.h5") if not p.name.startswith("checkpoint.previous"))
    what = changed(rng, rng.choice(files))
    shutil.copytree(folder / "run", folder / "kept")
    ends = []
    for words in (["plot", "kept"], ["report", "kept"], ["measure", "kept", "--json"],
                  [model, str(case), "-o", "run", "--resume", "--no-picture", "--until", until.replace("0.0", "0.03").replace("0.1", "0.15"), *settings]):
        code, out, err = ended(program, words, folder)
        ends.append(str(code))
        found = strange_text(code, out, err) or ("deaf" if code == "deaf" else None)
        if found:
            return f"{what}: {words[0]}: {found}", " ".join(ends)
    try:
        # What was changed in other files stays there.
        return strange_files(folder / "run") if ends[-1] == "0" and what.startswith("checkpoint") else None, " ".join(ends)
    except OSError:
        return None, " ".join(ends)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=lambda path: str(pathlib.Path(path).resolve()))
    parser.add_argument("first", type=int)
    parser.add_argument("last", type=int)
    parser.add_argument("-j", type=int, default=2)
    parser.add_argument("--mutants", action="store_true")
    parser.add_argument("--keep", type=pathlib.Path)
    asked = parser.parse_args()
    keys = [key for key in json.loads(subprocess.check_output([asked.program, "schema", "--json"]))["keys"] if not NOT_DRAWN.match(key["key"])]
    roles = json.loads(subprocess.check_output([asked.program, "list", "--json"]))["roles"]

    def one(n):
        with tempfile.TemporaryDirectory() as scratch:
            folder = pathlib.Path(scratch)
            found, end = strange_mutant(asked.program, n, folder) if asked.mutants else strange_scene(asked.program, n, keys, roles, folder)
            if found and asked.keep and (folder / "case.toml").exists():
                asked.keep.mkdir(parents=True, exist_ok=True)
                shutil.copy(folder / "case.toml", asked.keep / f"{n}.toml")
            return n, found, end

    ends, wrong = {}, 0
    with ThreadPoolExecutor(asked.j) as pool:
        for n, found, end in pool.map(one, range(asked.first, asked.last + 1)):
            ends[end] = ends.get(end, 0) + 1
            if found:
                wrong += 1
                print(f"{n}: {found}".replace("\n", " | "), flush=True)
    print(f"{asked.last - asked.first + 1} drawn, ends: " + ", ".join(f"{end}: {ends[end]}" for end in sorted(ends)) + f"; {wrong} strange")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
