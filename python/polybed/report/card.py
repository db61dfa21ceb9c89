"""The result card of a run: what its record says under `card`, else what follows from its history and its case."""

import numpy as np

from polybed.drawing.units import mean_text, text
from polybed.outflow import discharge_rate, mass_out, recovery
from polybed.page import escaped, table
from polybed.record import case_of, velocity_of

LAST = 0.25  # of the time: what a mean is over


def words_of(key):
    return escaped(str(key).replace("_", " "))


def value_of(value):
    """An entry of a card as HTML: a number, a text, a list, or a number with unit and interval."""
    if isinstance(value, bool) or value is None:
        return {True: "yes", False: "no", None: "&ndash;"}[value]
    if isinstance(value, (int, float)):
        return f"{value:.4g}"
    if isinstance(value, list):
        return "<br>".join(map(value_of, value))
    if isinstance(value, dict) and "value" in value:
        spread = next((value[key] for key in ("interval", "error", "plus_minus") if value.get(key) is not None), None)
        shown = value_of(value["value"])
        shown += "" if spread is None else f" &plusmn; {value_of(spread)}" if not isinstance(spread, list) else f" ({value_of(spread)})"
        return f"{shown} {escaped(value.get('unit') or '')}".strip()
    if isinstance(value, dict):
        return "<br>".join(f"{words_of(key)}: {value_of(entry)}" for key, entry in value.items())
    return escaped(value)


def recorded(card):
    """The card of the record as HTML: its lines as they are, or its entries."""
    if isinstance(card, dict) and isinstance(card.get("lines"), list):
        card = card["lines"]
    if isinstance(card, list) and all(isinstance(line, str) for line in card):
        return "<pre>" + "\n".join(map(escaped, card)) + "</pre>"
    if isinstance(card, list):
        card = {entry.get("name", n) if isinstance(entry, dict) else n: entry for n, entry in enumerate(card)}
    if isinstance(card, dict):
        return table([], [[words_of(key), value_of(value)] for key, value in card.items()], "words")
    return f"<p>{value_of(card)}</p>"


def mean_row(run, column, unit):
    """Mean of a column over the last quarter of the time, with its standard deviation; None without it."""
    history = run.history
    values = history.get(column)
    if values is None:
        return None
    time = history["time_s"]
    late = values[time >= time[-1] - LAST * (time[-1] - time[0])]
    late = late[np.isfinite(late)]
    if not len(late):
        return None
    return mean_text(float(late.mean()), float(late.std()), unit)


def bed_rows(run):
    """Heights, pressure drop over weight, mixing."""
    history, rows = run.history, []
    for column, title, unit in (("bed_height_m", "bed height", "m"), ("mixing", "mixing index (1 mixed, 0 apart)", "1")):
        shown = mean_row(run, column, unit) if column != "mixing" or len(run.species) > 1 else None
        if shown:
            rows.append([title, shown])
    if {"pressure_drop_Pa", "buoyant_weight_Pa"} <= history.keys() and np.any(history["pressure_drop_Pa"] != 0):
        weight, drop = history["buoyant_weight_Pa"], history["pressure_drop_Pa"]
        late = (history["time_s"] >= (1 - LAST) * history["time_s"][-1] + LAST * history["time_s"][0]) & (weight != 0)
        if late.any():
            ratio = drop[late] / weight[late]
            rows.append(["pressure drop over weight", f"{ratio.mean():.3g} &plusmn; {ratio.std():.2g}"])
    return rows


def outflow_rows(run):
    history, rows = run.history, []
    shares = recovery(history, run.species)
    for name, out in mass_out(history, run.species).items():
        rows.append([f"{escaped(name)} that left", f"{text(float(out[-1]), 'kg')}, recovery {100 * shares[name][-1]:.3g} %"])
    _, rate = discharge_rate(history, run.species)
    if len(rate):
        rows.append(["discharge rate, all species", f"{text(float(rate.mean()), 'kg/s')} (mean of the run)"])
    return rows


def species_rows(case):
    rows = []
    for species in case.get("species", []):
        if {"name", "diameter", "density"} <= species.keys():
            rows.append([escaped(species["name"]), f"{text(species['diameter'], 'm')}, {species['density']:.4g} kg/m\u00b3"])
    return rows


def steady_row(record):
    measures = record.get("drift", {}).get("measures", [])
    moving = [words_of(m.get("name", "")) for m in measures if not m.get("steady", True)]
    if not measures:
        return []
    window = record["drift"].get("window_s")
    over = f" over the last {text(window, 's')}" if isinstance(window, (int, float)) else ""
    return [["steady", ("no: " + ", ".join(moving) + " still changes" if moving else "yes") + over]]


def time_row(record):
    predicted = record.get("prediction", {})
    if "cpu_s" not in record or record.get("state") == "running":  # then it is of the last checkpoint
        return []
    shown = f"{text(record['cpu_s'], 's')} of computing for {text(record.get('time_s', 0), 's')} simulated"
    if "least_s" in predicted and "most_s" in predicted:
        shown += f"; predicted {text(predicted['least_s'], 's')} to {text(predicted['most_s'], 's')}"
    return [["time", shown]]


def computed(run):
    """What follows from history and record of a run without a card."""
    record, rows = run.record, []
    case = case_of(record)
    fluid, velocity = case.get("fluid", {}).get("name"), velocity_of(case)
    rows += species_rows(case)
    if fluid and fluid != "none":
        rows.append(["fluid", escaped(fluid) + (f", superficial velocity {text(velocity, 'm/s')}" if velocity else "")])
    if run.history and len(run.history["time_s"]):
        rows += bed_rows(run) + outflow_rows(run)
    rows += steady_row(record) + time_row(record)
    return table([], rows, "words") + '<p class="source">Means over the last quarter of the time, &plusmn; standard deviation; history.csv ' \
        "and run.json.</p>" if rows else ""


def card_of(run):
    """The card as HTML."""
    card = run.record.get("card")
    return f'<div class="card">{recorded(card) if card else computed(run)}</div>'
