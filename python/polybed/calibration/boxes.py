"""The boxes of a calibration: which are finished, and how the others are run."""

import json
import os
import time
from concurrent.futures import as_completed

from polybed.calibration.output import ERR, duration, say
from polybed.ending import FILE, NUMBERS, StudyError
from polybed.files import FAULTS, contents_of, finite, read_text
from polybed.runner import side_by_side, start

# What is read of a box: numbers, and means with their standard error.
SINGLE = ("solids_fraction", "stokes", "restitution", "friction", "share", "seed", "balance", "drift", "shear_rate_1_s", "diameter_m",
          "density_kg_m3", "strain", "drag_rate", "softness", "max_overlap", "cpu_s", "particle_steps", "bed_phi", "slip_over_sqrt_theta",
          "velocity_m_s")
MEANS = ("theta_m2_s2", "pressure_Pa", "viscosity_Pa_s", "temperature_ratio", "p_ratio", "mu_ratio", "gamma_ratio", "exchange_ratio",
         "p_bed", "p_bed_by_balance")


def read_box(path, digest):
    """A finished box of this hash, a dictionary; None if there is none or it is damaged: it is run again."""
    try:
        with contents_of(path):
            box = json.loads(read_text(path))
            if box["hash"] != digest:
                return None
            for number in (*(box[name] for name in SINGLE), *(value for name in MEANS for value in (box[name][0], box[name][1]))):
                finite(number)
    except FAULTS:
        return None
    return box


def run_all(jobs, at_once, finished):
    """Runs the program by jobs, {place: words}, in their order; `finished` is called with the place of each that ended with 0. Returns the
    places of those that failed."""
    failed = []
    with side_by_side(at_once) as threads:
        places = {threads.submit(lambda words: start(words, stdout=ERR, process_group=0).wait(), words): place for place, words in jobs.items()}
        for future in as_completed(places):
            if future.result() == 0:
                finished(places[future])
            else:
                failed.append(places[future])
    return failed


class Boxes:
    """Boxes that are run, with those finished before, in the order asked for."""

    def __init__(self, service, options, points):
        self.service, self.options, self.points = service, options, points
        named = service.ask("boxes", *(point.text() for point in points))
        self.names, self.expected = [name for name, _ in named], [seconds for _, seconds in named]
        self.done = [self.read(n) is not None for n in range(len(points))]

    def path(self, n):
        return self.options.output / "boxes" / f"{self.names[n]}.json"

    def read(self, n):
        return read_box(self.path(n), self.names[n])

    def left(self):
        """Places of those that are not finished, the longest first."""
        return sorted((n for n, done in enumerate(self.done) if not done), key=lambda n: -self.expected[n])

    def expected_left(self):
        """s, on one core."""
        return sum(self.expected[n] for n in self.left())

    def run(self):
        """Runs what is not finished; all results. Raises StudyError where boxes fail; finished ones are kept."""
        self.begin, self.all = time.monotonic(), self.expected_left()
        failed = self.run_on_ranks() if self.options.on_ranks else self.run_as_processes()
        if failed:
            raise StudyError(NUMBERS, f"{len(failed)} boxes failed, the first at phi = {self.points[failed[0]].phi:g}; finished ones are kept")
        results = [self.read(n) for n in range(len(self.points))]
        if None in results:
            raise StudyError(FILE, f"{self.path(results.index(None))}: the box that should lie here is not whole")
        return results

    def run_as_processes(self):
        """Returns the places of those that failed."""
        def finished(place):
            self.done[place] = True
            self.tell()
        jobs = {n: ["calibrate", "--box", str(os.getpid()), os.fspath(self.path(n)), self.options.case, self.points[n].text(),
                    *self.options.set] for n in self.left()}
        return run_all(jobs, self.options.jobs, finished)

    def run_on_ranks(self):
        """The same by the ranks of the program. The boxes that other ranks have finished are known by their files."""
        left = self.left()
        if not left:
            return []
        words = [word for n in left for word in (self.path(n), self.points[n].text())]
        answer = self.service.ask("run", *words)
        while answer is None:  # the first rank has finished a box
            self.look()
            answer = self.service.answer()
        if self.left():
            self.look()
        return [left[n] for n in answer]

    def look(self):
        for n in self.left():
            self.done[n] = self.read(n) is not None
        self.tell()

    def tell(self):
        if self.options.quiet:
            return
        passed, left = time.monotonic() - self.begin, self.expected_left()
        say(f"{sum(self.done)} of {len(self.done)} boxes; about {duration(passed * left / max(self.all - left, 1e-9))} left\n", ERR)
