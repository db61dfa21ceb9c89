"""Serves report.html with the progress above it on the loopback address: what `polybed watch` hands over to. The page asks for new data as
long as the run goes on; the server ends with the run, once a browser has had the last state."""

import argparse
import os
import re
import sys
import threading
import time
from collections import Counter
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

from polybed.texts import text
from polybed.ending import DONE, guarded
from polybed.files import FAULTS, contents_of, opened
from polybed.page import markup, section
from polybed.read import Snapshot
from polybed.folder import case_of
from polybed.report import sections
from polybed.report.build import drawn, embedded, page_of, parts, told, under, write
from polybed.study.output import writes

LOOPBACK = "127.0.0.1"
RENEWED = 2.0  # s between two looks at the run
SHARE = 0.1  # greatest share of the time for looking at the run
LAST_LOOK = 5.0  # s that the server waits, after the end, for a browser to take the last state
KNOWN = re.compile(r"(-1|[0-9]{1,9})?")  # version of the state that a page has, -1 of none
TAIL = 64_000  # bytes of steps.csv that are read for what limits now
# The page asks, shows what is new, and stops asking when the run has ended.
FOLLOW = """(async () => {
  const where = { end: true };
  for (let version = -1;;) {
    await new Promise(go => setTimeout(go, %d));
    let found;
    try { found = await (await fetch("data.json?" + version)).json(); }
    catch { document.getElementById("progress-text").textContent = "the server has ended"; return; }
    if (found.version !== version) {
      version = found.version;
      for (const [name, text] of Object.entries(found.html)) { const part = document.getElementById(name); if (part) part.innerHTML = text; }
      if (found.data) await window.polybedShow(found.data, where);
    }
    if (found.ended) return;
  }
})();"""


def limits_now(directory):
    """What limited the latest steps, by their number, most often first: [(reason, steps)]."""
    try:
        with opened(directory / "steps.csv") as file:
            file.seek(max(0, os.fstat(file.fileno()).st_size - TAIL))
            lines = file.read().decode("utf-8", "replace").split("\n")[1:-1]
    except FAULTS:
        return []
    return Counter(reason for _, reason in sections.rows_of_steps(lines)).most_common()


class Watched:
    """A run that is looked at again and again: what the server answers with."""

    def __init__(self, directory):
        self.run = Snapshot(directory)
        self.directory, self.first = self.run.directory, None  # (time of the clock, simulated time) when the run was seen first
        self.version, self.seen, self.ended = 0, -1, False
        self.wait, self.answer, self.lock = RENEWED, b"{}", threading.Lock()

    def look(self):
        """Reads the run as it is now. Raises what reading raises."""
        begin = time.monotonic()
        goes_on = writes(self.directory)
        run = Snapshot(self.directory)
        with contents_of(self.directory):
            html = {"under": under(run), "progress": markup("<h2>Progress</h2>{}", self.shown(run, goes_on))}
            for name, (title, words) in parts(run).items():
                if words and name in ("card", "limits", "invariants"):
                    html[name] = markup("<h2>{}</h2>{}", title, words)
            data = drawn(run)
        text_of = embedded({"version": self.version + 1, "ended": not goes_on, "html": html, "data": data})
        with self.lock:
            self.run, self.version, self.answer, self.ended = run, self.version + 1, text_of.encode(), not goes_on
        self.wait = max(RENEWED, (time.monotonic() - begin) / SHARE)

    def progress(self, run, goes_on):
        """(share done, line): share None if the end is not known; how long it still takes is by what was simulated while it was watched."""
        now = float(max(run.history.get("time_s", ()), default=0.0))
        end = case_of(run.record).get("run", {}).get("until")
        state = run.record.get("state", "no run.json yet")
        if not isinstance(end, (int, float)) or end <= 0:
            return None, f"{text(now, 's')} simulated, {state}"
        line = f"{text(now, 's')} of {text(end, 's')} simulated"
        if not goes_on:
            return now / end, f"{line}, {'no process writes this run' if state == 'running' else state}"
        self.first = self.first or (time.time(), now)
        seconds, simulated = time.time() - self.first[0], now - self.first[1]
        return now / end, line + (f", about {text((end - now) * seconds / simulated, 's', 2)} left" if simulated > 0 else "")

    def shown(self, run, goes_on):
        share, line = self.progress(run, goes_on)
        bar = "" if share is None else markup('<progress value="{}"></progress>', f"{max(0.0, min(1.0, share)):.4f}")
        now = limits_now(self.directory)
        step = run.record.get("step", {}).get("limited_by")
        why = ", ".join(f"{reason} ({count} of the last steps)" for reason, count in now[:3]) or step
        return markup('{}<p id="progress-text">{}</p>{}', bar, line, markup("<p>Steps are limited by: {}</p>", why) if why else "")

    def page(self):
        """The page as a browser gets it first."""
        with self.lock:
            run, ended = self.run, self.ended
        with contents_of(self.directory):
            return page_of(run, section("progress", "Progress", self.shown(run, not ended)), [FOLLOW % int(1e3 * RENEWED)])

    def data(self, known):
        """The newest state, without what the page has already; whether it is the last."""
        with self.lock:
            if known == self.version:
                return embedded({"version": known, "ended": self.ended, "html": {}, "data": None}).encode(), self.ended
            return self.answer, self.ended


def handler_of(watched, port):
    class Handler(BaseHTTPRequestHandler):
        def do_GET(self):
            # a page of elsewhere that has its name point to this machine is not answered
            if self.headers.get("Host") not in (f"{LOOPBACK}:{port()}", f"localhost:{port()}"):
                return self.send_error(HTTPStatus.FORBIDDEN)
            place, _, query = self.path.partition("?")
            try:
                if place == "/":
                    return self.send(watched.page().encode("utf-8", "replace"), "text/html; charset=utf-8")
                if place == "/data.json":
                    if not KNOWN.fullmatch(query):
                        return self.send_error(HTTPStatus.BAD_REQUEST)
                    content, last = watched.data(int(query or -1))
                    self.send(content, "application/json")
                    watched.seen = watched.version if last else watched.seen
                    return None
            except FAULTS as error:
                return self.send_error(HTTPStatus.INTERNAL_SERVER_ERROR, explain=str(error))
            return self.send_error(HTTPStatus.NOT_FOUND)

        def send(self, content, kind):
            self.send_response(HTTPStatus.OK)
            for name, value in (("Content-Type", kind), ("Content-Length", str(len(content))), ("Cache-Control", "no-store")):
                self.send_header(name, value)
            self.end_headers()
            self.wfile.write(content)

        def log_message(self, *words):
            """Requests are not told."""

    return Handler


class Server(ThreadingHTTPServer):
    daemon_threads = True

    def handle_error(self, request, client_address):
        """A browser that closes its connection early is no error."""
        if not isinstance(sys.exc_info()[1], ConnectionError):
            super().handle_error(request, client_address)


def follow(watched):
    """Looks at the run until it has ended and a browser has seen that, or none comes."""
    while not watched.ended:
        time.sleep(watched.wait)
        try:
            watched.look()
        except FAULTS as error:  # a file that is being replaced: the next look reads it
            print(error, file=sys.stderr)
            if not watched.directory.is_dir():
                raise
    until = time.monotonic() + LAST_LOOK
    while watched.seen != watched.version and time.monotonic() < until:
        time.sleep(0.1)


def serve(directory, port):
    watched = Watched(directory)
    watched.look()
    if watched.ended:
        print(f"no process writes {watched.directory}; its page is {told(*write(watched.directory))}")
        return
    server = Server((LOOPBACK, port), handler_of(watched, lambda: server.server_address[1]))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    print(f"http://{LOOPBACK}:{server.server_address[1]}/ shows {watched.directory} until the run ends; Ctrl-C ends it before", flush=True)
    try:
        follow(watched)
    finally:
        server.shutdown()
        server.server_close()


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="polybed watch", description="Serves a page that follows a run.")
    parser.add_argument("run", help="run directory")
    parser.add_argument("--port", type=int, default=0, help="default: any that is free")
    options = parser.parse_args(arguments)
    return guarded(lambda: serve(options.run, options.port) or DONE, "")
