"""What to expect of a case, as `polybed check` answers."""

from __future__ import annotations

import tomllib
from typing import Any

from polybed.page import markup

FIRST = ("expected", "notes", "refused", "time")
LAST = "case"


class Check(dict[str, Any]):
    """The answer of polybed.check: a dictionary, the answers first. Printed, it is the text of `polybed check`."""

    def __init__(self, found: dict[str, Any]) -> None:
        self.lines = found["lines"]
        expected = found["expected"]
        found = found | {"expected": {name: expected[name] for name in dict.fromkeys(("state", "bed_height_m", *expected))}}
        names = dict.fromkeys([*FIRST, *(name for name in found if name not in (LAST, "lines")), LAST])
        super().__init__({name: found[name] for name in names if name in found})

    def __repr__(self) -> str:
        """The card of what to expect, the notes, and why a model refuses the case."""
        lines = [tomllib.loads(self["case"]).get("title") or "a case without a title", *self.lines, "", *(f"note: {note}" for note in self["notes"])]
        return "\n".join(lines + [f"polybed {model}   refused: {why}" for model, reasons in self["refused"].items() for why in reasons])

    def _repr_html_(self) -> str:
        return markup("<pre>{}</pre>", repr(self))
