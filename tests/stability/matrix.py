#!/usr/bin/python3
"""Writes the matrix of hard cases from the report of the tests.

  build/tests/test_stability --gtest_output=json:REPORT
  tests/stability/matrix.py REPORT... docs/stability.md   replaces the tables between the marks of the page
  tests/stability/matrix.py REPORT... --expected          prints the table of outcomes as expected.csv has it
"""
import datetime
import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
BEGIN, END = "<!-- matrix: begin -->", "<!-- matrix: end -->"


def results(reports):
    suites = [s for report in reports for s in json.loads(pathlib.Path(report).read_text())["testsuites"]]
    tests = [t for suite in suites for t in suite["testsuite"]]
    return [t for t in tests if "outcome" in t]


def of_product(rows):
    lines = ["| case | set-up | scheme | outcome | furthest invariant | value | of its limit | least step | steps (rejected) | CPU s |",
             "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |"]
    for row in rows:
        if row["treatment"].startswith("naive"):
            continue
        least = row["least_step"] + " s" if row["least_step"] != "0" else "-"
        share = "nothing allowed" if float(row["limit"]) == 0 and float(row["value"]) > 0 else row["share"]
        steps = f"{row['steps']} ({row['rejected']})" if row["steps"] != "0" else "-"
        lines.append(f"| {row['case']} | {row['title']} | {row['treatment']} | {row['outcome']} | {row['worst']} | "
                     f"{row['value']} | {share} | {least} | {steps} | {row['cpu']} |")
    return lines


def of_textbook(rows):
    lines = ["| case | textbook treatment | outcome | how it fails |", "| --- | --- | --- | --- |"]
    for row in rows:
        if not row["treatment"].startswith("naive"):
            continue
        how = row["cause"] or f"{row['worst']}: {row['value'].replace('1e+300', 'not a number')}, limit {row['limit']}"
        lines.append(f"| {row['case']} | `{row['treatment'][6:]}` | {row['outcome']} | {how} |")
    return lines


def figures(rows):
    return [f"- {row['case']}, {row['treatment']}: {row['reported'].strip()}" for row in rows if row["reported"]]


def page(rows, text):
    commit = subprocess.run(["git", "-C", str(ROOT), "describe", "--always", "--dirty"], capture_output=True, text=True).stdout.strip()
    tables = [f"Measured {datetime.date.today()} at commit {commit}, {sum(float(r['cpu']) for r in rows):.0f} CPU s in all.", "",
              *of_product(rows), "", *of_textbook(rows), "", "Reported beside:", "", *figures(rows)]
    head, rest = text.split(BEGIN)
    return head + BEGIN + "\n" + "\n".join(tables) + "\n" + END + rest.split(END)[1]


if __name__ == "__main__":
    found = results(sys.argv[1:-1])
    if sys.argv[-1] == "--expected":
        print("case,treatment,outcome,broken")
        for result in found:
            print(f"{result['case']},{result['treatment']},{result['outcome']},{result['broken']}")
    else:
        target = pathlib.Path(sys.argv[-1])
        target.write_text(page(found, target.read_text()))
