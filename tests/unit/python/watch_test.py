#!/usr/bin/python3
"""The server of the page of a run that goes on: watch_test.py WRITER PACKAGE_DIRECTORY"""

import fcntl
import json
import socket
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import urllib.error
import urllib.request
from pathlib import Path

WRITER, PACKAGE = sys.argv[1], sys.argv[2]
sys.path.insert(0, PACKAGE)

from report_pages import Page, add_case


class Watch(unittest.TestCase):
    """A lock on the mark stands for the process that writes."""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.directory = Path(scratch.name) / "bed-tfm"
        subprocess.run([WRITER, self.directory, "2"], check=True)
        add_case(self.directory, state="running")
        self.mark = open(self.directory / ".polybed", "w")
        self.addCleanup(self.mark.close)
        fcntl.flock(self.mark, fcntl.LOCK_EX)

    def start(self, **streams):
        child = subprocess.Popen([sys.executable, "-u", f"{PACKAGE}/polybed/isolated.py", "polybed.report.watch", self.directory], stdout=subprocess.PIPE, text=True, **streams,
                                 env={"PYTHONPATH": PACKAGE})
        self.addCleanup(child.stdout.close)
        self.addCleanup(child.kill)
        return child, child.stdout.readline().split()[0]

    def get(self, place, host=None):
        request = urllib.request.Request(place, headers={"Host": host} if host else {})
        with urllib.request.urlopen(request, timeout=30) as answer:
            return answer.read().decode()

    def test_a_browser_that_disconnects_causes_no_message(self):
        child, place = self.start(stderr=subprocess.PIPE)
        self.addCleanup(child.stderr.close)
        host, port = place.split("/")[2].split(":")
        for _ in range(5):
            with socket.create_connection((host, int(port))) as browser:
                browser.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))  # closes by a reset
                browser.sendall(f"GET / HTTP/1.1\r\nHost: {host}:{port}\r\n\r\n".encode())
        self.assertIn("Progress", self.get(place))
        child.terminate()
        self.assertEqual(child.communicate(timeout=30)[1], "")

    def test_it_follows_a_run_and_ends_with_it(self):
        child, place = self.start()
        self.assertTrue(place.startswith("http://127.0.0.1:"))
        page = Page(self.get(place))
        self.assertEqual(page.loaded, [])
        self.assertIn("Progress", "".join(page.text))
        state = json.loads(self.get(place + "data.json?-1"))
        self.assertFalse(state["ended"])
        self.assertIn("1 s of 1 s simulated", state["html"]["progress"])
        self.assertIsNone(json.loads(self.get(place + f"data.json?{state['version']}"))["data"] if not state["ended"] else None)
        for other in ("evil.example", "127.0.0.1:1"):
            with self.assertRaises(urllib.error.HTTPError) as refused:
                self.get(place, other)
            self.assertEqual(refused.exception.code, 403)
            refused.exception.close()
        for wrong, code in (("run.json", 404), ("data.json?--5", 400), ("data.json?" + "9" * 5000, 400), ("data.json?%C2%B2", 400),
                            ("data.json?-2", 400), ("data.json?1&2", 400)):
            with self.assertRaises(urllib.error.HTTPError) as refused:
                self.get(place + wrong)
            self.assertEqual(refused.exception.code, code, wrong[:20])
            refused.exception.close()
        self.mark.close()
        until = time.monotonic() + 60
        while not state["ended"] and time.monotonic() < until:
            state = json.loads(self.get(place + "data.json?-1"))
            time.sleep(0.2)
        self.assertTrue(state["ended"])
        self.assertIn("no process writes this run", state["html"]["progress"])
        self.assertEqual(child.wait(60), 0)

    def test_a_run_that_has_ended_gets_its_page(self):
        self.mark.close()
        child, _ = self.start()
        self.assertEqual(child.wait(60), 0)
        self.assertTrue((self.directory / "report.html").exists())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
