"""The history of a run, and several runs with a row each, as frames of pandas."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from polybed.checks import Check
from polybed.errors import MissingError
from polybed.overrides import keys_of_case
from polybed.packages import needed
from polybed.quantities import unit_of_column
from polybed.study.output import writes

with needed(False):
    import pandas as pd

if TYPE_CHECKING:
    from polybed.read import Run


def frame(run: Run) -> Any:
    """The history as a pandas.DataFrame: a row for each time, index time_s in seconds, columns as in history.csv. The unit ends a
    column's name, and `frame.attrs["units"]` has it by column. Entries without value are NaN."""
    columns = dict(run.history)
    time = columns.pop("time_s", np.empty(0))
    table = pd.DataFrame(columns, index=pd.Index(time, name="time_s"))
    table.attrs["units"] = {name: unit_of_column(name) for name in columns}
    return table


def keys_of(case: str) -> dict[str, Any]:
    """The keys of a resolved case by dotted names, those of a species by its name. A velocity that is constant is one number."""
    keys = keys_of_case(case)
    constant = {key: value[0][1] for key, value in keys.items()
                if key.endswith("superficial_velocity") and isinstance(value, list) and len(value) == 1}
    return keys | constant


def record_of(run: Run) -> dict[str, Any]:
    """The record of a run; one that no process writes any more, as after a kill, does not run. Raises MissingError."""
    if not (record := run.record):
        raise MissingError(f"{run.directory} has no run.json: a run writes it at its start")
    return record | {"state": "stopped"} if record["state"] == "running" and not writes(run.directory) else record


def table(rows: Iterable[Run | Check]) -> pd.DataFrame:
    """A row for each run: the keys in which the cases differ, the model if there are several, the state of the run, and the numbers and
    words of its card, a mean with its interval as two columns; those that are alike in all rows come last. The index is the folder."""
    each = list(rows)
    records = [{"case": one["case"], "model": "check"} if isinstance(one, Check) else record_of(one) for one in each]
    cards = [dict(card_of(one["expected"] if isinstance(one, Check) else one.card)) for one in each]
    keys = [keys_of(record.get("case", "")) for record in records]
    first = [key for key in dict.fromkeys(itertools.chain(*keys)) if any(one.get(key) != keys[0].get(key) for one in keys)]
    first += ["model"] if len({record.get("model") for record in records}) > 1 else []
    first += ["run_state"] if any("state" in record for record in records) else []
    found = [own | {"model": record.get("model"), "run_state": record.get("state")} | card for own, record, card in zip(keys, records, cards)]
    seen = dict.fromkeys(itertools.chain(*cards))
    values = {name: [row.get(name) for row in found] for name in seen}
    rest = sorted(seen, key=lambda name: (values[name].count(None) == len(each), values[name].count(values[name][0]) == len(each)))
    index = [str(getattr(one, "directory", "check")) for one in each]
    return pd.DataFrame(found, columns=[*first, *rest], index=pd.Index(index, name="run")).fillna(np.nan).infer_objects()  # None is no number


def card_of(card: dict[str, Any], above: str = "") -> Iterator[tuple[str, Any]]:
    """The entries of a card by dotted names; {"value", "interval"} as name and name_interval."""
    for name, value in card.items():
        if isinstance(value, list):  # the same in words, or no single number
            continue
        if isinstance(value, dict) and value.keys() == {"value", "interval"}:
            yield from ((above + name, value["value"]), (f"{above}{name}_interval", value["interval"]))
        elif isinstance(value, dict):
            yield from card_of(value, f"{above}{name}.")
        else:
            yield above + name, value
