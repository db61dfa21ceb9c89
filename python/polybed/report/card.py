"""The result card of a run, in the words of the card on the screen: what its record says under `card`."""

from polybed.drawing.units import mean_text, text
from polybed.page import markup, source, table
from polybed.record import case_of, velocity_of


def listed(values, unit):
    """Values of the species, each with the unit that fits; one alone without its name. "mixture" is that of all."""
    known = {name: value for name, value in values.items() if value is not None}
    if len({name for name in values if name != "mixture"}) == 1:
        return text(next(iter(known.values())), unit) if known else ""
    return ", ".join(f"{name} {text(value, unit)}" for name, value in known.items())


def mean_of(entry, unit):
    """A mean with its 95 % interval as the card has both."""
    value, interval = entry["value"], entry.get("interval")
    return text(value, unit, 4) if interval is None else mean_text(value, interval, unit)


def bed_of(card):
    words = [card["state"] and card["state"].replace("_", " "), card["layers"]]
    if card["bed_height_m"] and not (card["state"] or "").startswith("carried"):
        words.append(mean_of(card["bed_height_m"], "m") + " high")
    if card["pressure_drop_over_weight"] and card["state"]:
        words.append(f"pressure drop {mean_of(card['pressure_drop_over_weight'], '1')} of the weight")
    return ", ".join(filter(None, words))


def recorded(card):
    """The card of the record, with the words of the card on the screen."""
    bed = bed_of(card)
    rows = [["bed", bed]] if bed else []
    if card["u_mf_m_s"]:
        ratio = card["u_over_u_mf"]
        inlet = f"; the inlet's velocity is {ratio:.2g} times that" if ratio else ""
        rows.append(["fluidises at", listed(card["u_mf_m_s"], "m/s") + inlet])
    falling = {name: speed for name, speed in (card["terminal_m_s"] or {}).items() if speed is not None}
    if falling:
        rows.append(["falls at", listed(falling, "m/s")])
    if card["geldart"]:
        rows.append(["Geldart class", ", ".join(f"{name} {kind}" for name, kind in card["geldart"].items())])
    if card["mixing"] is not None:
        rows.append(["mixing", f"{card['mixing']:.2f} (1 mixed, 0 separated)"])
    for name, mass in (card["out_kg"] or {}).items():
        share = (card["recovery"] or {}).get(name)
        rows.append([f"{name} that left", text(1e3 * mass, "g") + ("" if share is None else f" ({100 * share:.3g} %)")])
    if card["discharge_kg_s"] is not None:
        rows.append(["discharge", text(1e3 * card["discharge_kg_s"], "g/s")])
    moving = "the bed still changes; the numbers above are not final" if card["discharge_kg_s"] is None else \
        "particles still left, or what remains still moves"
    if card["bed_height_m"] or card["steady"] is not None:
        rows.append(["steady", {True: "yes", False: f"no: {moving}",
                                None: "not known: too few rows in history.csv"}[card["steady"]]])
    if card["limited_by"]:
        rows.append(["step", f"limited by {card['limited_by']}"])
    rows.append(["left out", card["left_out"]])
    taken, predicted = card["time_s"]["taken"], card["time_s"]["predicted"]
    if taken is not None:
        rows.append(["time", f"{text(taken, 's')} of computing, predicted {text(predicted, 's')}"])
    note = source("means over the last quarter of the time with their 95 % intervals; polybed explain WORD says what a word means")
    return table([], [row for row in rows if row[1]], "words") + note


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
    """Of a run that has not yet written a card: what it is of."""
    record = run.record
    case = case_of(record)
    fluid, velocity = case.get("fluid", {}).get("name"), velocity_of(case)
    rows = species_rows(case) + time_row(record)
    if fluid and fluid != "none":
        rows.append(["fluid", fluid + (f", superficial velocity {text(velocity, 'm/s')}" if velocity else "")])
    return table([], rows, "words") if rows else ""


def card_of(run):
    card = run.record.get("card")
    return markup('<div class="card">{}</div>', recorded(card) if card else of_case(run))
