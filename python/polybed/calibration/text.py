"""A table beside its file: the same as TOML, and what the boxes have measured, for people."""

import math

import numpy as np

from polybed.calibration.fit import relative_errors, shear_number


def listed(values):
    return "[" + ", ".join(f"{value:.6g}" for value in np.ravel(values)) + "]"


def spread(boxes, name):
    """The least and greatest of a number of the boxes."""
    return listed([min(box[name] for box in boxes), max(box[name] for box in boxes)])


def table_toml(table, plan, boxes, coefficients):
    """TOML of a table of sheared boxes. coefficients: a of chi_eff = chi_CS (1 + a S) at each point of a dry table"""
    a = table.attributes
    text = "".join(f"{name} = {value}\n" for name, value in (
        ("filetype", '"polybed solids table"'), ("version", 1), ("git_commit", f'"{a["git_commit"]}"'), ("created", f'"{a["created"]}"'),
        ("case_hash", f'"{a["case_hash"]}"'), ("regime", f'"{plan.regime}"'), ("regime_reason", f'"{plan.case["reason"]}"'),
        ("reference", f'"{a["reference"]}"'), ("fit_residual", f"{a['fit_residual']:.4g}"),
        ("left_out_residual", f"{a['left_out_residual']:.4g}"), ("greatest_error", f"{max(relative_errors(table)):.4g}"),
        ("lambda", f"{a['lambda']:.6g}"), ("size_ratio", f"{a['size_ratio']:.6g}"), ("boxes", len(boxes)),
        ("particle_steps", f"{sum(box['particle_steps'] for box in boxes):.4g}"), ("cpu_s", f"{sum(box['cpu_s'] for box in boxes):.4g}"),
        *((name, spread(boxes, name)) for name in ("balance", "softness", "max_overlap", "drift", "strain", "drag_rate"))))
    text += "\n[axes]\n" + "".join(f"{name} = {listed(table[name])}\n" for name in ("phi", "stokes", "e", "mu_p", "x2"))
    quantities = {"seeds": "p_ratio_n", "p": "p_ratio", "p_se": "p_ratio_se", "mu": "mu_ratio", "mu_se": "mu_ratio_se",
                  "gamma": "gamma_ratio", "gamma_se": "gamma_ratio_se", "T_12": "T_ratio_12", "T_12_se": "T_ratio_12_se", "S": "S",
                  "beta_12": "beta_12_ratio", "beta_12_se": "beta_12_ratio_se"}
    text += "\n[ratios]  # [phi][stokes][e][mu_p][x2]\n"
    text += "".join(f"{name} = {listed(table[array])}\n" for name, array in quantities.items() if array in table.arrays)
    return text + (f"\n[fit]  # chi_eff = chi_CS (1 + a S)\na = {listed(coefficients)}\n" if plan.regime == "dry" else "")


def measured(mean, per=1.0):
    return f"{mean[0] / per:.4g}+-{mean[1] / per:.1g}"


def box_lines(boxes):
    """One line for each box, with a header; of two species also their temperatures and what they exchange."""
    lines = (f"{'phi':>6} {'St':>6} {'e':>6} {'mu_p':>5} {'x2':>5} {'seed':>4} {'S':>7} {'theta/(g d)^2':>16} {'p':>16} {'mu':>16} "
             f"{'p/ref':>7} {'mu/ref':>7} {'G/ref':>7} {'balance':>8}\n")
    for box in boxes:
        if box["pushed"]:
            continue
        rate, diameter = box["shear_rate_1_s"], box["diameter_m"]
        unit = box["density_kg_m3"] * diameter * diameter * rate
        lines += (f"{box['solids_fraction']:>6g} {box['stokes']:>6g} {box['restitution']:>6g} {box['friction']:>5g} {box['share']:>5g} "
                  f"{box['seed']:>4} {shear_number(box):>7.4g} {measured(box['theta_m2_s2'], math.pow(rate * diameter, 2)):>16} "
                  f"{measured(box['pressure_Pa'], unit * rate):>16} {measured(box['viscosity_Pa_s'], unit):>16} {box['p_ratio'][0]:>7.4g} "
                  f"{box['mu_ratio'][0]:>7.4g} {box['gamma_ratio'][0]:>7.4g} {box['balance']:>8.5f}\n")
    return lines + ("phi: solids fraction; St: Stokes number of the shear; e, mu_p: restitution and friction of particles; x2: share of the second "
                    "species\nS: number of the shear in the fit; theta/(g d)^2: granular temperature over (shear rate x diameter)^2; p, mu: solids "
                    "pressure and viscosity over density,\n  shear rate and diameter; p, mu, G over ref: over kinetic theory, G the dissipation; "
                    "balance: work of the shear over dissipation\n") + species_lines(boxes)


def species_lines(boxes):
    binary = [box for box in boxes if box["binary"]]
    if not binary:
        return ""
    lines = f"{'phi':>6} {'e':>6} {'x2':>5} {'seed':>4} {'T_2/T_1':>16} {'beta_12/ref':>16} {'slip':>8} {'balance':>8}\n"
    for box in binary:
        exchange = measured(box["exchange_ratio"]) if box["pushed"] else ""
        lines += (f"{box['solids_fraction']:>6g} {box['restitution']:>6g} {box['share']:>5g} {box['seed']:>4} "
                  f"{measured(box['temperature_ratio']):>16} {exchange:>16} {box['slip_over_sqrt_theta']:>8.3f} {box['balance']:>8.5f}\n")
    return lines
