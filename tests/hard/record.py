#!/usr/bin/python3
"""Renews the table of docs/record/stability.md from a run of all hard cases, 300 CPU s:
polybed stability --suite full --naive all -j 2 -o RUN, then tests/hard/record.py RUN."""
import json
import re
import sys
from collections import Counter
from pathlib import Path

PAGE = Path(__file__).resolve().parents[2] / "docs/record/stability.md"
BEGIN, END = "<!-- matrix: begin -->\n", "<!-- matrix: end -->\n"
FOUR = {"explicit/limited", "explicit/upwind", "imex/limited", "implicit/limited"}


def over(worst):
    """An invariant and its value over its limit; the value where nothing is allowed."""
    value, limit = worst["value"], worst["limit"]
    ratio = value / limit if limit > 0 else value
    text = "> 1e300" if ratio > 1e300 else f"{ratio:.0f}" if 10 <= ratio < 1e4 else f"{ratio:.2g}".replace("e+0", "e").replace("e+", "e")
    return f"{worst['id']}, {text}" + ("" if limit > 0 else ", limit 0")


def row(cells):
    """(case with its set-up, worst invariant, textbook schemes), the last two empty where there is nothing to show."""
    product = [cell for cell in cells if not cell["naive"]]
    schemes = {cell["scheme"] for cell in product}
    named = [f"{cell['scheme']} {cell['outcome']}" for cell in product if cell["outcome"] != "PASS"]
    if schemes < FOUR and len(schemes) < len(FOUR):
        named = [cell["scheme"] + ("" if cell["outcome"] == "PASS" else " " + cell["outcome"]) for cell in product]
    worst = max((cell["worst"] for cell in product), key=lambda w: w["value"] / w["limit"] if w["limit"] > 0 else 0)
    failed = [f"`{cell['naive']}`: " + (f"stops at {float(at[1]):.2g} s" if (at := re.match(r"t = ([-+.\de]+) s", cell["cause"])) else
                                        over(cell["worst"])) for cell in cells if cell["naive"]]
    return (cells[0]["case"], cells[0]["title"] + (f" ({', '.join(named)})" if named else ""), over(worst) if worst["value"] > 0 < worst["limit"]
            else "", "; ".join(failed))


def main():
    run = json.loads((Path(sys.argv[1]) / "stability.json").read_text())
    cases = {}
    for cell in run["cells"]:
        cases.setdefault(cell["case"], []).append(cell)
    rows = [row(cells) for cells in cases.values()]
    counts = [Counter(cell["outcome"] for cell in run["cells"] if bool(cell["naive"]) == naive) for naive in (False, True)]
    product, textbook = (", ".join(f"{count[outcome]} {outcome}" for outcome in ("PASS", "DEGRADED", "REFUSED", "FAIL") if count[outcome])
                         for count in counts)
    table = "".join(f"| {case} | {title} | {worst or '-'} | {failed} |\n" for case, title, worst, failed in rows if failed)
    rest = ";\n".join(f"**{case}** {title}: {worst}" for case, title, worst, failed in rows if worst and not failed)
    nothing = ", ".join(case + title[title.find(" ("):] * title.endswith(")") for case, title, worst, failed in rows if not worst and not failed)
    text = (f"`polybed stability --suite full --naive all -j 2`, {run['date']}, commit {run['git_commit'][:8]}, "
            f"{sum(cell['cpu_s'] for cell in run['cells']):.0f} CPU s: {product}; textbook schemes {textbook}.\n\n| case | set-up | worst invariant, over its limit | textbook scheme that fails, over its limit |\n"
            f"| --- | --- | --- | --- |\n{table}\nRegression tests, without a textbook scheme, and the worst invariant over its limit:\n{rest}.\n\n"
            f"Regression tests with nothing above 0: {nothing}. The command prints what they are.\n")
    before, rest_of_page = PAGE.read_text().split(BEGIN)
    PAGE.write_text(before + BEGIN + text + END + rest_of_page.split(END)[1])


if __name__ == "__main__":
    main()
