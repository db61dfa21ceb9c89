#!/usr/bin/python3
"""The page of a run in a browser without a screen: no error in the console, the slider and the particles move, from a file and served.
Ends with 77, skipped, where there is no chromium. Usage: report_browser_test.py WRITER PACKAGE_DIRECTORY"""

import fcntl
import html
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

WRITER, PACKAGE = sys.argv[1], sys.argv[2]
sys.path.insert(0, PACKAGE)

from polybed.page import allowed
from report_pages import EVIL, add_case

SKIPPED = 77
CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
LONGEST = 120  # s; a start takes a second on a quiet core
# What somebody who looks at the page does, and what is then on the screen: sums over the pixels of every canvas.
PROBE = """(async () => {
  const wait = n => new Promise(go => setTimeout(go, n));
  for (let n = 0; n < 100 && !document.body.dataset.shown; ++n) await wait(50);
  const sums = part => [...document.querySelectorAll(part + " canvas")].filter(c => c.getClientRects().length).map(c => {
    const copy = document.createElement("canvas"), to = copy.getContext("2d", { willReadFrequently: true });
    copy.width = c.width; copy.height = c.height;
    to.drawImage(c, 0, 0);
    const d = to.getImageData(0, 0, c.width, c.height).data;
    let sum = 0;
    for (let n = 0; n < d.length; n += 4) sum += (d[n] * 3 + d[n + 1] * 5 + d[n + 2] * 7) * (n % 1009);
    return sum;
  });
  const found = { errors: window.errors, shown: document.body.dataset.shown, title: document.title };
  const slider = document.getElementById("slider"), label = () => document.querySelector("output").textContent;
  found.last = [label(), sums("#bed-view"), sums("#history-view")];
  slider.value = 0;
  slider.dispatchEvent(new Event("input"));
  found.first = [label(), sums("#bed-view"), sums("#history-view")];
  const view = document.getElementById("particles"), kind = document.getElementById("kind");
  if (view) {
    found.drawn = Number(view.dataset.drawn); found.outlines = Number(view.dataset.outlines);
    const at = (name, x) => view.dispatchEvent(new PointerEvent(name, { clientX: x, clientY: 100, pointerId: 1, bubbles: true }));
    view.setPointerCapture = () => {};
    at("pointerdown", 100); at("pointermove", 190); at("pointerup", 190);
    found.turned = sums("#bed-view");
    view.dispatchEvent(new MouseEvent("dblclick"));
    found.back = sums("#bed-view");
  }
  if (kind) { kind.value = "velocity"; kind.dispatchEvent(new Event("change")); found.velocity = sums("#bed-view"); }
  document.body.replaceChildren();
  const told = document.createElement("pre");
  told.id = "told"; told.textContent = JSON.stringify(found);
  document.body.append(told);
})();"""
ERRORS = "window.errors = []; addEventListener('error', e => errors.push(String(e.message))); addEventListener('unhandledrejection', e => errors.push(String(e.reason)));"


def look(place, scratch):
    """(what the probe has found or the page as it stands, lines of the console) of a page that the browser opens."""
    words = [CHROMIUM, "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--enable-logging=stderr",
             f"--user-data-dir={scratch}/browser", "--virtual-time-budget=20000", "--dump-dom", place]
    with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True) as child:
        try:
            page, said = child.communicate(timeout=LONGEST)
        finally:
            if child.poll() is None:  # its helpers too
                os.killpg(child.pid, signal.SIGKILL)
    return page, [line for line in said.split("\n") if "CONSOLE" in line]


def add_walls(directory):
    """A wall and a round opening in the case of a sample run."""
    path = directory / "run.json"
    record = json.loads(path.read_text())
    record["case"] += "[column]\nsize = [0.06, 0.02, 0.2]\n[dem]\nopening = 0.01\n[[wall]]\nfrom = [0.0, 0.15]\nto = [0.02, 0.01]\n"
    path.write_text(json.dumps(record))


class Browser(unittest.TestCase):
    kind = 2

    def setUp(self):
        scratch = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)
        self.directory = self.folder / "bed"
        subprocess.run([WRITER, self.directory, str(self.kind)], check=True)
        add_case(self.directory)

    def probed(self):
        subprocess.run([sys.executable, f"{PACKAGE}/polybed/isolated.py", "polybed.report.build", self.directory], check=True, env={"PYTHONPATH": PACKAGE},
                       stdout=subprocess.DEVNULL)
        text = (self.directory / "report.html").read_text()
        self.assertEqual(text.count("</body>"), 1)
        probe = self.folder / "probe.html"
        self.assertIn("script-src ", text)
        text = text.replace("script-src ", f"script-src {html.escape(allowed([ERRORS, PROBE]))} ", 1)
        probe.write_text(text.replace("<body>", f"<body><script>{ERRORS}</script>", 1).replace("</body>", f"<script>{PROBE}</script></body>"))
        page, console = look(probe.as_uri(), self.folder)
        self.assertEqual(console, [])
        found = json.loads(html.unescape(re.search(r'<pre id="told">(.*?)</pre>', page, re.S)[1]))
        self.assertEqual(found["errors"], [])
        self.assertEqual(found["title"], EVIL, "no name has run")
        return found

    def slide(self):
        add_walls(self.directory)
        found = self.probed()
        self.assertEqual((found["first"][0], found["last"][0]), ("t = 0 s", "t = 1 s"))
        for part in (1, 2):
            self.assertGreater(len(found["first"][part]), 0)
            self.assertNotEqual(found["first"][part], found["last"][part])
            self.assertTrue(all(found["first"][part]), "a canvas is blank")
        return found


class BrowserOfFields(Browser):
    def test_the_slider_moves_all_that_depends_on_time(self):
        found = self.slide()
        self.assertNotEqual(found["velocity"], found["first"][1])

    def test_nothing_runs_that_the_page_does_not_name(self):
        """What would get past the escapes: neither a script nor a handler of an element runs, and nothing is loaded."""
        subprocess.run([sys.executable, f"{PACKAGE}/polybed/isolated.py", "polybed.report.build", self.directory], check=True, env={"PYTHONPATH": PACKAGE},
                       stdout=subprocess.DEVNULL)
        path = self.directory / "report.html"
        evil = '<script>document.title="ran"</script><img src="data:," onerror="document.title=\'ran\'"><img src="picture.png">'
        path.write_text(path.read_text().replace("</h1>", "</h1>" + evil, 1))
        page, console = look(path.as_uri(), self.folder)
        self.assertNotIn("<title>ran", page)
        self.assertEqual(sum("Content Security Policy" in line for line in console), 3, console)

    def test_a_page_that_follows_a_run(self):
        """The server is asked again until the run has ended; the page then says so."""
        add_case(self.directory, state="running")
        with open(self.directory / ".polybed", "w") as mark:
            fcntl.flock(mark, fcntl.LOCK_EX)
            child = subprocess.Popen([sys.executable, "-u", f"{PACKAGE}/polybed/isolated.py", "polybed.report.watch", self.directory], stdout=subprocess.PIPE, text=True,
                                     env={"PYTHONPATH": PACKAGE})
            self.addCleanup(child.stdout.close)
            self.addCleanup(child.kill)
            place = child.stdout.readline().split()[0]
            page, console = look(place, self.folder)
            self.assertEqual(console, [])
            self.assertIn("1 s of 1 s simulated", page)
        self.assertEqual(child.wait(LONGEST), 0)


class BrowserOfParticles(Browser):
    kind = "particles"

    def test_the_slider_moves_all_that_depends_on_time(self):
        found = self.slide()
        self.assertEqual((found["drawn"], found["outlines"]), (300, 2))
        self.assertNotEqual(found["turned"], found["first"][1])
        self.assertEqual(found["back"], found["first"][1], "a double click turns it back")


if __name__ == "__main__":
    if CHROMIUM is None:
        print("skipped: there is no chromium")
        sys.exit(SKIPPED)
    unittest.main(argv=sys.argv[:1])
