"""Cases as the program resolves them: whole, in SI, with every key; and in what two of them differ."""

import tomllib

from polybed.ending import WRONG_CASE, StudyError
from polybed.folder import velocity_of
from polybed.overrides import keys_of_case, toml
from polybed.runner import answer_of, words_of

FREE = ("tfm.", "dem.", "output.")  # tables that can differ between runs of one case


class Case:
    """A case file with overrides, resolved. Raises ProgramError if it is wrong. until: simulated time, as --until has it, or None"""

    def __init__(self, path, overrides, until=None):
        end = ["--until", until] if until else []
        found = answer_of("check", path, *words_of(overrides), *end, "--resolved")
        self.path, self.overrides = str(path), found["overrides"]  # the end among them
        self.text, self.hash, self.scan_hash = found["case"], found["hash"], found["scan_hash"]
        self.git_commit = found["git_commit"]  # of the program
        self.refused = found["refused"]  # by each model: why it cannot run the case
        self.keys = tomllib.loads(self.text)
        self.velocity = velocity_of(self.keys)  # superficial, at the end, m/s; None in a closed column
        self.species = [species["name"] for species in self.keys["species"]]
        law = self.keys.get("effects", {}).get("solids_stress", "")
        self.table = law.removeprefix("table:") if law.startswith("table:") else None  # path of its table of the solids stress, a text


def refuse_without_ends(keys, what):
    """Refuses a study of a bed for a box whose ends are joined in a fluid. keys: of the case"""
    if keys["column"].get("ends") == "periodic" and keys["fluid"]["name"] != "none":
        raise StudyError(WRONG_CASE, f'{what}: a box with column.ends = "periodic" has no height and no inlet; polybed compare gives its slips')


def hash_of(content):
    """FNV-1a hash of bytes, 64 bits, as 16 hexadecimal digits: as the program has it of the text of a case."""
    found = 0xCBF29CE484222325
    for byte in content:
        found = (found ^ byte) * 0x100000001B3 % 2**64
    return f"{found:016x}"


def laws_of(role):
    """The laws of a role of [effects], by their names."""
    return [law["law"] for found in answer_of("list")["roles"] if found["role"] == role for law in found["laws"]]


def roles_in_both_models():
    """Names of the effects that act in either model."""
    models = {}
    for role in answer_of("list")["roles"]:
        models.setdefault(role["role"], set()).update(role["models"].split(", "))
    return {name for name, found in models.items() if {"tfm", "dem"} <= found}


def differences(first, second, in_both):
    """The keys in which two resolved cases differ, each with both values, "-" for none. Left out are [tfm], [dem], [output], run.until, the
    title, and a role of [effects] that is not in both models."""
    def may_differ(key):
        if key.startswith("effects."):
            return key.removeprefix("effects.") not in in_both
        return key in ("title", "run.until") or key.startswith(FREE)

    a, b = ({key: toml(value) for key, value in keys_of_case(text).items()} for text in (first, second))
    found = [(key, a.get(key, "-"), b.get(key, "-")) for key in sorted(a.keys() | b.keys())]
    return [entry for entry in found if entry[1] != entry[2] and not may_differ(entry[0])]
