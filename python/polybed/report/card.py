"""The result card of a run, in the words of the card on the screen: what its record says under `card`."""

from polybed.drawing.units import text
from polybed.page import markup, source, table
from polybed.record import case_of, velocity_of

HEADING = 14  # columns of a line before what it says


def recorded(lines):
    """The lines of the card, as the screen has them."""
    note = source("means over the last quarter of the time with their 95 % intervals; polybed explain WORD says what a word means")
    return table([], [[line[:HEADING].strip(), line[HEADING:]] for line in lines], "words") + note


def species_rows(case):
    rows = []
    for species in case.get("species", []):
        if {"name", "diameter", "density"} <= species.keys():
            rows.append([species["name"], f"{text(species['diameter'], 'm')}, {species['density']:.4g} kg/m\u00b3"])
    return rows


def time_row(record):
    predicted = record.get("prediction", {})
    if "cpu_s" not in record or record.get("state") == "running":  # then it is of the last checkpoint
        return []
    shown = f"{text(record['cpu_s'], 's')} of computing for {text(record.get('time_s', 0), 's')} simulated"
    if "least_s" in predicted and "most_s" in predicted:
        shown += f"; predicted {text(predicted['least_s'], 's')} to {text(predicted['most_s'], 's')}"
    return [["time", shown]]


def of_case(run):
    """The bed of a run that has not yet written a card."""
    record = run.record
    case = case_of(record)
    fluid, velocity = case.get("fluid", {}).get("name"), velocity_of(case)
    rows = species_rows(case) + time_row(record)
    if fluid and fluid != "none":
        rows.append(["fluid", fluid + (f", superficial velocity {text(velocity, 'm/s')}" if velocity else "")])
    return table([], rows, "words") if rows else ""


def card_of(run):
    lines = run.card.get("lines")
    return markup('<div class="card">{}</div>', recorded(lines) if lines else of_case(run))
