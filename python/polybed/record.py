"""What run.json says of the case: its keys, its title, and the species with their properties."""

import tomllib

from polybed.files import DamagedError


def case_of(record):
    """The resolved case of a record as a dictionary; empty if it has none. Raises DamagedError."""
    try:
        return tomllib.loads(record.get("case") or "")
    except (tomllib.TOMLDecodeError, TypeError, AttributeError) as error:
        raise DamagedError("the case in run.json", error) from error


def drift_lines(record):
    """What a run still drifts by at its end, a line each: the slope is certain, and matters (docs/reference/measures.md)."""
    try:
        return list(record.get("drift", {}).get("lines", []))
    except (AttributeError, TypeError) as error:
        raise DamagedError("the drift in run.json", error) from error


def title_of_case(record):
    """The title that the case gives itself; empty without one, or where the case cannot be read."""
    try:
        title = case_of(record).get("title", "")
    except DamagedError:
        return ""
    return title if isinstance(title, str) else ""


def velocity_of(case):
    """The last superficial velocity of the inlet, m/s; None without one, and of several side by side."""
    rows = case.get("inlet", {}).get("superficial_velocity")
    if isinstance(rows, (int, float)):
        return float(rows)
    try:
        return float(rows[-1][1])
    except (TypeError, IndexError, ValueError):
        return None
