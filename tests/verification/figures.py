#!/usr/bin/python3
"""Prints the figures that tests record, as a Markdown table: figures.py TEST_PROGRAM [GTEST_FILTER]

Each row is a test, the name of a figure, and its value. Particle tests record "obtained expected error allowed" in one text.
"""
import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

OURS = {"name", "value_param", "type_param", "file", "line", "status", "result", "timestamp", "time", "classname", "failures"}


def figures(report):
    """(test, figure, value) of a report of googletest in JSON, in the order of the tests."""
    for suite in report["testsuites"]:
        for test in suite["testsuite"]:
            for key, value in test.items():
                if key not in OURS:
                    yield f"{test['classname']}.{test['name']}", key, value


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "report.json"
        begin = time.monotonic()
        command = [sys.argv[1], f"--gtest_output=json:{path}", "--gtest_brief=1"] + [f"--gtest_filter={f}" for f in sys.argv[2:3]]
        code = subprocess.run(command, stdout=sys.stderr, check=False).returncode
        print("| test | figure | value |\n| --- | --- | --- |")
        for row in figures(json.loads(path.read_text())):
            print("| " + " | ".join(row) + " |")
        print(f"\n{time.monotonic() - begin:.0f} s")
    sys.exit(code)
