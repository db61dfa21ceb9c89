"""Numbers with units, lengths of time and tables as text; tables of pages are in polybed.page."""


def text_table(head, rows, align="<", gap="  "):
    """Columns under each other, as wide as their widest cell. align: "<" or ">"; a line keeps no blanks at its end"""
    lines = [list(map(str, line)) for line in (head, *rows)]
    widths = [max(map(len, column)) for column in zip(*lines)]
    return "\n".join(gap.join(f"{cell:{align}{width}}" for cell, width in zip(line, widths)).rstrip() for line in lines)


def right_table(head, rows):
    """Numbers, all to the right."""
    return text_table(head, rows, ">", " ") + "\n"


def markdown_table(head, rows):
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join(f"| {' | '.join(map(str, line))} |" for line in lines)


PREFIXES = ((1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "\u00b5"), (1e-9, "n"))
WHOLE = {"1", "", "kg/m3"}  # units that stand without a prefix
SHOWN = {"1": "", "m2/s2": "m\u00b2/s\u00b2"}
GRAMS = {"kg": "g", "kg/s": "g/s"}  # the prefixes stand before these


def fitting(unit, greatest):
    """(factor, unit) in which the greatest of numbers reads as 1 to 1000. All 0, or without a unit, they keep it."""
    name = SHOWN.get(unit, unit)
    if unit in WHOLE or not 0 < greatest < float("inf"):
        return 1.0, name
    power, per = 2 if unit == "m2/s2" else 1, 1e3 if unit in GRAMS else 1.0
    # The greatest prefix of which there is at least one, else the smallest.
    size, prefix = next((each for each in PREFIXES if per * greatest * (1 + 1e-9) >= each[0]**power), PREFIXES[-1])
    return (1.0, unit) if unit in GRAMS and prefix == "k" else (per * size**-power, prefix + GRAMS.get(unit, name))


def text(value, unit, digits=3):
    """A number with the unit that fits, as in 2.3 mm/s."""
    factor, name = fitting(unit, abs(value))
    return f"{value * factor:.{digits}g} {name}".strip()


def percent(share, error=None, none="\u2013"):
    """A share in per cent: "0.4 \u00b1 0.1 %". none: stands for no number"""
    if share is None:
        return none
    return f"{100 * share:.2g}" + (f" \u00b1 {100 * error:.1g}" if error else "") + " %"


def duration(seconds):
    """A length of time for people: "42 s", "3 min 20 s", "2 h 5 min"."""
    s = int(seconds + 0.5)
    if s < 60:
        return f"{s} s" if s else f"{seconds:.2g} s"
    return f"{s // 60} min {s % 60} s" if s < 3600 else f"{s // 3600} h {s % 3600 // 60} min"
