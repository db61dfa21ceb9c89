"""What to expect of a case, as `polybed check` answers."""

from __future__ import annotations

import functools
from typing import Any

from polybed.page import markup
from polybed.runner import call

FIRST = ("expected", "notes", "refused", "time")
LAST = "case"


class Check(dict[str, Any]):
    """The answer of polybed.check: a dictionary, the answers first. Printed, it is the text of `polybed check`."""

    def __init__(self, found: dict[str, Any], words: tuple[object, ...]) -> None:
        expected = found["expected"]
        found = found | {"expected": {name: expected[name] for name in dict.fromkeys(("state", "bed_height_m", *expected))}}
        names = dict.fromkeys([*FIRST, *(name for name in found if name != LAST), LAST])
        super().__init__({name: found[name] for name in names if name in found})
        self.words = words

    @functools.cached_property
    def text(self) -> str:
        """The card of what to expect, the notes, and why a model refuses the case."""
        lines = [line for line in call("check", *self.words).splitlines() if not line.startswith("more: ")]
        lines += [f"polybed {model}   refused: {why}" for model, reasons in self["refused"].items() for why in reasons]
        return "\n".join(lines)

    def __repr__(self) -> str:
        return self.text

    def _repr_html_(self) -> str:
        return markup("<pre>{}</pre>", self.text)
