"""Keys of a case file with their values, as Python has them and as the program takes them."""

from __future__ import annotations

import json
import os
import tomllib
from collections.abc import Iterator, Mapping
from typing import Any

from polybed.errors import ArgumentError

Value = Any  # text, number, truth, list or dictionary of such; array or number of numpy
Overrides = Mapping[str, Value]


def plain(value: Value, key: str) -> Value:
    """A value without numpy: text, number, truth, or a list or a dictionary of such. Raises TypeError with the key."""
    if hasattr(value, "tolist"):  # arrays and numbers of numpy
        value = value.tolist()
    if isinstance(value, os.PathLike):
        value = os.fspath(value)
    if isinstance(value, (list, tuple)):
        return [plain(entry, key) for entry in value]
    if isinstance(value, dict):
        return {name: plain(entry, key) for name, entry in value.items()}
    if isinstance(value, (str, bool, int, float)):
        return value
    raise ArgumentError(f"{key}: a value of type {type(value).__name__} ({value!r}); allowed are texts, numbers, lists, arrays and dictionaries")


def toml(value: Value) -> str:
    """A plain value as a case file has it."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{json.dumps(name)} = {toml(entry)}" for name, entry in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(toml, value)) + "]"
    return repr(value) if isinstance(value, float) else json.dumps(value, ensure_ascii=False)  # repr: inf and nan are TOML's too


def flat(overrides: Overrides | None, table: str = "") -> Iterator[tuple[str, Value]]:
    """(key, value) with dots in the key for each level of dictionaries: {"tfm": {"rtol": 1e-4}} is tfm.rtol."""
    if not isinstance(overrides, Mapping | None):
        raise ArgumentError(f"overrides: {overrides!r} is no dictionary of keys of the case file, {{'tfm.rtol': 1e-4}}")
    for name, value in (overrides or {}).items():
        key = f"{table}{name}"
        if isinstance(value, dict):
            yield from flat(value, key + ".")
        else:
            yield key, plain(value, key)


def keys_of_case(text: str) -> dict[str, Value]:
    """The keys of a resolved case by dotted names; tables of an array have their names, or count from 1."""
    case = tomllib.loads(text)
    for name, entries in case.items():
        if isinstance(entries, list):
            case[name] = {str(entry.get("name", n)): entry for n, entry in enumerate(entries, start=1)}
    return dict(flat(case))
