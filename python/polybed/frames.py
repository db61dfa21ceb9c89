"""The history of a run, and several runs with a row each, as frames of pandas."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from polybed.overrides import keys_of_case
from polybed.packages import needed
from polybed.quantities import unit_of_column

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


def keys_of(run: Run) -> dict[str, Any]:
    """The keys of a run's resolved case by dotted names, those of a species by its name. A velocity that is constant is one number."""
    keys = keys_of_case(run.record.get("case", ""))
    constant = {key: value[0][1] for key, value in keys.items()
                if key.endswith("superficial_velocity") and isinstance(value, list) and len(value) == 1}
    return keys | constant


def table(runs: Iterable[Run]) -> pd.DataFrame:
    """A row for each run: the keys in which the cases differ, the model if the runs are of both, the state of the run, and the numbers and
    words of its card, a mean with its interval as two columns. The index is the folder."""
    each = list(runs)
    keys = [keys_of(run) for run in each]
    differ = [key for key in dict.fromkeys(itertools.chain(*keys)) if any(one.get(key) != keys[0].get(key) for one in keys)]
    of_both = len({run.record.get("model") for run in each}) > 1
    rows = []
    for run, own in zip(each, keys):
        model = {"model": run.record.get("model")} if of_both else {}
        rows.append({key: own.get(key) for key in differ} | model | {"run_state": run.record.get("state")} | dict(card_of(run.card)))
    return pd.DataFrame(rows, index=pd.Index([str(run.directory) for run in each], name="run"))


def card_of(card: dict[str, Any], above: str = "") -> Iterator[tuple[str, Any]]:
    """The entries of a card by dotted names; {"value", "interval"} as name and name_interval."""
    for name, value in card.items():
        if name == "lines":  # the same in words
            continue
        if isinstance(value, dict) and value.keys() == {"value", "interval"}:
            yield from ((above + name, value["value"]), (f"{above}{name}_interval", value["interval"]))
        elif isinstance(value, dict):
            yield from card_of(value, f"{above}{name}.")
        else:
            yield above + name, value
