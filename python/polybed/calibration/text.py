"""A table as TOML, and what the boxes have measured, for people; and points that a table was not fitted to, compared with it."""

import json
import math

import numpy as np

from polybed.calibration.boxes import Point
from polybed.calibration.fit import relative_errors, rows_of_bed, shear_number
from polybed.solids_table import AXES
from polybed.texts import right_table

# Columns of the place of a box in the table, each with the entry that it shows.
PLACE = {"phi": "solids_fraction", "St": "stokes", "e": "restitution", "mu_p": "friction", "x2": "share", "seed": "seed"}
MEANING = """phi: solids fraction; St: Stokes number of the shear; e, mu_p: restitution and friction of particles
x2: share of the second species; theta: granular temperature; g, d: shear rate and diameter
p, mu: pressure and viscosity of the solids over density, g and d; ref: by kinetic theory
G: energy lost in collisions
"""
SEED = 1001  # one that no plan has


def shown(value):
    """A text, a number or an array as TOML has it, arrays without their shape."""
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    return f"{value:.6g}" if np.ndim(value) == 0 else f"[{', '.join(f'{one:.6g}' for one in np.ravel(value))}]"


def table_toml(table, plan, boxes, coefficients):
    """TOML of a table of sheared boxes. coefficients: a of chi_eff = chi_CS (1 + a S) at each point of a dry table"""
    kept = ("filetype", "version", "git_commit", "created", "case_hash", "regime", "reference", "fit_residual", "left_out_residual", "lambda",
            "size_ratio")
    head = {name: table.attributes[name] for name in kept} | {
        "regime_reason": plan.case["reason"], "greatest_error": max(relative_errors(table)), "boxes": len(boxes)}
    head |= {name: sum(box[name] for box in boxes) for name in ("particle_steps", "cpu_s")}
    head |= {name: [min(box[name] for box in boxes), max(box[name] for box in boxes)]
             for name in ("balance", "softness", "max_overlap", "drift", "strain", "drag_rate")}
    quantities = {"seeds": "p_ratio_n", "p": "p_ratio", "p_se": "p_ratio_se", "mu": "mu_ratio", "mu_se": "mu_ratio_se",
                  "gamma": "gamma_ratio", "gamma_se": "gamma_ratio_se", "T_12": "T_ratio_12", "T_12_se": "T_ratio_12_se", "S": "S",
                  "beta_12": "beta_12_ratio", "beta_12_se": "beta_12_ratio_se"}
    parts = {"": head, "\n[axes]\n": {name: table[name] for name in AXES},
             "\n[ratios]  # [phi][stokes][e][mu_p][x2]\n": {name: table[array] for name, array in quantities.items() if array in table.arrays}}
    parts |= {"\n[fit]  # chi_eff = chi_CS (1 + a S)\n": {"a": coefficients}} if plan.regime == "dry" else {}
    return "".join(heading + "".join(f"{name} = {shown(value)}\n" for name, value in part.items()) for heading, part in parts.items())


def measured(mean, per=1.0):
    return f"{mean[0] / per:.4g}±{mean[1] / per:.1g}"


# Columns of what was measured: (heading, text of a box)
SHEARED = (("theta/(g d)^2", lambda box: measured(box["theta_m2_s2"], math.pow(box["shear_rate_1_s"] * box["diameter_m"], 2))),
           ("p", lambda box: measured(box["pressure_Pa"], unit_of(box) * box["shear_rate_1_s"])),
           ("mu", lambda box: measured(box["viscosity_Pa_s"], unit_of(box))),
           ("p/ref", lambda box: f"{box['p_ratio'][0]:.3g}"), ("mu/ref", lambda box: f"{box['mu_ratio'][0]:.3g}"),
           ("G/ref", lambda box: f"{box['gamma_ratio'][0]:.3g}"))
OF_TWO = (("T_2/T_1", lambda box: measured(box["temperature_ratio"])),
          ("beta_12/ref", lambda box: measured(box["exchange_ratio"]) if box["pushed"] else ""),
          ("slip", lambda box: f"{box['slip_over_sqrt_theta']:.3f}"))


def unit_of(box):
    return box["density_kg_m3"] * box["diameter_m"] ** 2 * box["shear_rate_1_s"]


def table_lines(boxes, quantities):
    """A line for each box, at most 100 columns wide, below the entries that all of them share."""
    texts = {name: [f"{box[entry]:g}" for box in boxes] for name, entry in PLACE.items()}
    texts |= {name: [text(box) for box in boxes] for name, text in quantities}
    same = [name for name in PLACE if name not in ("phi", "seed") and len(set(texts[name])) == 1]
    head = [name for name in texts if name not in same]
    shared = f"in all boxes {', '.join(f'{name} {texts[name][0]}' for name in same)}\n" if same else ""
    return shared + right_table(head, zip(*map(texts.get, head)))


def between(values, digits):
    return f"{min(values):.{digits}g} to {max(values):.{digits}g}"


def box_lines(boxes):
    """One line for each sheared box, with a header; of two species also their temperatures and what they exchange."""
    sheared, binary = [box for box in boxes if not box["pushed"]], [box for box in boxes if box["binary"]]
    lines = table_lines(sheared, SHEARED) + MEANING
    lines += (f"number of the shear in the fit (S) {between([shear_number(box) for box in sheared], 4)}; "
              f"work of the shear over dissipation {between([box['balance'] for box in sheared], 5)}\n")
    return lines + ("\n" + table_lines(binary, OF_TWO) if binary else "")


def points_between(table, binary):
    """Three points between knots: middles of the first, middle and last gap in phi, of two Stokes numbers (ln), first knots else."""
    phi, stokes = list(map(float, table["phi"])), list(map(float, table["stokes"]))
    half = (len(stokes) - 1) // 2
    middle = math.sqrt(stokes[half] * stokes[half + 1]) if len(stokes) > 1 else stokes[0]
    gaps = sorted({0, (len(phi) - 1) // 2, len(phi) - 2})
    first = (float(table[name][0]) for name in ("e", "mu_p", "x2"))
    place = (middle, *first, binary, False, SEED)
    return [Point(table.attributes["regime"], 0.5 * (phi[gap] + phi[gap + 1]), *place) for gap in gaps]


def deviation(box, ratios, inertia):
    """(box over table, less 1; standard error of both together, relative) of p and of mu. ratios: p, p one standard error up, mu, mu
    likewise, as a run reads the table; inertia: its lambda"""
    found = []
    for name, mean, up in (("p_ratio", *ratios[:2]), ("mu_ratio", *ratios[2:])):
        table = (1 + inertia * box["stokes"]) * mean
        found.append((box[name][0] / table - 1, math.hypot(box[name][1] / table, up / mean - 1)))
    return found


def deviation_lines(points, deviations):
    """For people, with how many standard errors each is."""
    def told(off, error):
        return f"{100 * off:+.1f} % +- {100 * error:.1f} ({abs(off) / error if error else math.inf:.1f} se)"

    head = ("phi", "St", "p, box over table", "mu, box over table")
    return right_table(head, [[f"{point.phi:.4g}", f"{point.stokes:.4g}", told(*p), told(*mu)] for point, (p, mu) in zip(points, deviations)])


def bed_lines(boxes):
    head = ("planned", "phi", "seed", "p_bed by slabs", "by balance", "slabs/balance")
    return right_table(head, [[f"{box['solids_fraction']:g}", f"{box['bed_phi']:.4f}", box["seed"], measured(box["p_bed"]),
                               measured(box["p_bed_by_balance"]), f"{box['p_bed'][0] / box['p_bed_by_balance'][0]:.3f}"] for box in boxes])


def bed_rows(table):
    head = ("mm/s", "phi", "p_bed by slabs", "by balance", "difference", "theta")
    return right_table(head, [[f"{1e3 * velocity:.3f}", f"{phi:.4f}", measured((slabs, slabs_error)), measured((balance, balance_error)),
                               f"{100 * (balance / slabs - 1):+.1f} %", f"{theta:.3g}"]
                              for (phi, slabs, slabs_error, balance, balance_error), velocity, theta in zip(rows_of_bed(table), table["velocity"],
                                                                                                           table["theta_bed"])])
