"""What a finished run of pareto_b.py says: means over the last quarter with their intervals, and what it took."""
import numpy as np

from polybed.cost.runner import counters_of, weighed

STUDENT = 2.262  # 95 %, nine degrees of freedom
FIRST, SECOND = "fine", "coarse"


def interval(values):
    """Mean and half-width of its 95 % interval by ten batches."""
    batches = [np.mean(part) for part in np.array_split(values, 10)]
    return float(np.mean(values)), float(STUDENT * np.std(batches, ddof=1) / np.sqrt(10))


def measured(run, cells, common):
    """Means over the last quarter of a run that is done, lengths in mm, and what it took; "common" ones over these times, s, too, if it
    is long enough for them."""
    history, record = run.history, run.record
    late = history["time_s"] >= 0.75 * history["time_s"][-1]
    height = 1e3 * history["bed_height_m"]
    apart = 1e3 * (history[f"centre_{SECOND}_m"] - history[f"centre_{FIRST}_m"])
    drop = np.mean(history["pressure_drop_Pa"][late] / history["buoyant_weight_Pa"][late])
    simulated = record["time_s"]
    found = {"state": "done", "simulated_s": simulated, "cpu_s": record["cpu_s"], "work_s": weighed(counters_of(record, cells)),
             "drift_mm_s": float(np.polyfit(history["time_s"][late], height[late], 1)[0]), "drop_over_weight": float(drop),
             "broken": [w for w in record["warnings"] if "exceeded" in w]}
    found["bed_height_mm"], found["bed_height_ci_mm"] = interval(height[late])
    found["apart_mm"], found["apart_ci_mm"] = interval(apart[late])
    begin, end = common if common[1] <= history["time_s"][-1] else (0.75 * history["time_s"][-1], history["time_s"][-1])
    within = (history["time_s"] >= begin) & (history["time_s"] <= end)
    found["common_height_mm"], found["common_height_ci_mm"] = interval(height[within])
    found["common_apart_mm"], found["common_apart_ci_mm"] = interval(apart[within])
    share = interval((apart / height)[late])
    found["centre_difference"], found["centre_difference_ci"] = share
    found["commit"], found["integrator"] = record["git_commit"], record["integrator"]
    return found


def crossing(points):
    """Where the centres change places between runs from the mixed start: (velocity, mean, half-width), by rising velocity.

    Between two neighbours that are certain and of opposite sign, linear; else what is known is a bound."""
    certain = [(u, value) for u, value, error in points if abs(value) > error]
    for (u, value), (v, other) in zip(certain, certain[1:]):
        if value > 0 > other:
            return {"state": "between", "mm_s": 1e3 * (u + (v - u) * value / (value - other)), "error_mm_s": 500 * (v - u),
                    "low_mm_s": 1e3 * u, "high_mm_s": 1e3 * v}
    above = [u for u, value in certain if value > 0]
    below = [u for u, value in certain if value < 0]
    return {"state": "not found", "mm_s": None, "low_mm_s": in_mm(max(above, default=None)),
            "high_mm_s": in_mm(min(below, default=None))}


def in_mm(velocity):
    return None if velocity is None else 1e3 * velocity
