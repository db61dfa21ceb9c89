"""Draws a run, or in its place the folder of a study as at its end: what `polybed plot` and the end of a run hand over to."""

import argparse
import importlib
import json
import sys
import warnings
from pathlib import Path

from polybed.errors import MissingError
from polybed.packages import needed
from polybed.progress import Bar

with needed(False):
    import matplotlib.pyplot as plt

    from polybed.drawing import animation, history, maps, overview, particles, profiles
    from polybed.drawing.style import STYLE
    from polybed.ending import WRONG_CASE, StudyError, made
    from polybed.files import FAULTS, contents_of, in_place, put_text, read_json
    from polybed.particles import step_shown
    from polybed.read import Snapshot, nearest, stored_times

# Records of studies: kind of file, endings of the pictures, and the module with draw(record, folder) for these and, if there is a page,
# text_of(record, path) for it.
STUDIES = {"comparison.json": ("polybed comparison", (), "polybed.drawing.comparison"),
           "inversion.json": ("polybed inversion", ("png",), "polybed.drawing.inversion_scan"),
           "cost.json": ("polybed cost", ("png", "svg"), "polybed.drawing.cost"),
           "stability.json": ("polybed stability", ("png", "svg"), "polybed.drawing.hard_cases"),
           "closure_uncertainty.json": ("polybed closure uncertainty", ("png",), "polybed.drawing.drag_law"),
           "fit.json": ("polybed drag fit", ("png",), "polybed.drawing.drag_law")}
WHAT = ("overview", "fields", "particles", "profiles", "history", "animation")


def save(figure, path):
    """Puts a picture in place whole."""
    try:
        with in_place(path) as temporary:
            figure.savefig(temporary, format=path.suffix[1:])
        return path
    finally:
        plt.close(figure)


def study_drawn(path, out=None):
    """Draws the record of a study in its folder or another; its page goes beside the record, if pictures do. Returns the paths."""
    filetype, endings, module = STUDIES[path.name]
    study, found, folder = importlib.import_module(module), read_json(path, filetype), Path(out or path.parent)
    if endings:
        folder.mkdir(parents=True, exist_ok=True)
    with plt.rc_context(STYLE), contents_of(path):
        paths = [save(study.draw(found, path.parent), folder / f"{path.stem}.{ending}") for ending in endings]
        if hasattr(study, "text_of") and not (paths and out):
            paths.append(put_text(path.with_suffix(".html"), study.text_of(found, path)))
        return paths


def step_of(run, time):
    """Number of the stored step nearest to a time, of the last worth showing if None; a time that is not covered is refused."""
    stored, what = stored_times(run), "particles" if len(run.particles) else "fields"
    if len(stored) == 0:
        raise MissingError(f"{run.directory} has no stored fields yet, and no particles")
    if time is None:
        return step_shown(run.particles.count) if len(run.particles) else len(stored) - 1
    first, last = stored[0], stored[-1]
    if not first <= time <= last * (1 + 1e-9):
        raise StudyError(WRONG_CASE, f"--time {time:g} s is not covered: {what} are stored from {first:g} to {last:g} s")
    return nearest(stored, time)


def kinds_of(run):
    """What there is to draw of a run."""
    stored = {"fields": run.fields, "particles": run.particles, "profiles": run.profiles, "history": run.history}
    return tuple(what for what in WHAT if what not in stored or len(stored[what]))


def picture(directory, time=None):
    """Draws a run at a time (the last one if None) in one picture, and returns its path."""
    run = Snapshot(directory)
    step = step_of(run, time)
    with plt.rc_context(STYLE), contents_of(run.directory):
        return save(overview.draw(run, step), run.directory / "picture.png")


def draw_one(run, what, time, folder, ending, rate=None, progress=None):
    """Draws one kind of picture of an open run and returns its path."""
    step = step_of(run, time)
    shown = stored_times(run)[step]
    if what in ("fields", "particles") and what not in kinds_of(run):
        raise StudyError(WRONG_CASE, f"--what {what}: {run.directory} holds no {what}; there are {', '.join(kinds_of(run))}")
    if what == "animation":
        return animation.film(run, folder / ("animation.mp4" if animation.has_ffmpeg() else "animation.gif"), rate, progress)
    draw = {"overview": lambda: overview.draw(run, step), "fields": lambda: maps.draw(run, run.step_at(shown)),
            "particles": lambda: particles.draw(run, step), "profiles": lambda: profiles.draw(run, shown),
            "history": lambda: history.draw(run, None if time is None else shown)}
    return save(draw[what](), folder / f"{what}.{ending}")


def pictures(directory, what=None, time=None, out=None, ending="png", rate=None, progress=None):
    """Draws the chosen pictures of a run (by default all) into a folder (RUN/pictures) and returns their paths."""
    run = Snapshot(directory)
    what = kinds_of(run) if what is None else what
    if unknown := set(what) - set(WHAT):
        raise StudyError(WRONG_CASE, f"there is no picture {min(unknown)!r}; there are {', '.join(WHAT)}, all")
    step_of(run, time)
    folder = Path(out) if out else run.directory / "pictures"
    if folder.is_symlink() and not out:
        raise FileExistsError(f"{folder} is a link, which polybed does not follow: name the folder with --out")
    folder.mkdir(parents=True, exist_ok=True)
    with plt.rc_context(STYLE), contents_of(run.directory):
        return [draw_one(run, one, time, folder, ending, rate, progress) for one in what]


def at_end(directory, time=None):
    """Draws picture.png and makes report.html and the ports for ParaView, as a run does at its end, and returns what to say of them. A picture
    that cannot be made is an error; of a page that cannot be made the reason is returned."""
    from polybed.report import ports
    from polybed.report.build import told, write
    drawn = picture(directory, time)
    try:
        found = ports.write(directory)
        return f"{drawn}, {told(*write(directory))}" + (f", {found}" if found else "")
    except FAULTS as error:
        return f"{drawn}; no report.html: {error}"


def parsed(arguments):
    parser = argparse.ArgumentParser(prog="polybed plot", description="Draws a finished or a running run.")
    parser.add_argument("run", help="run directory")
    parser.add_argument("--what", default="all", help="one or several, by commas: " + ", ".join(WHAT) + ", all")
    parser.add_argument("--time", type=float, help="s; the stored time nearest to it (default: the last)")
    parser.add_argument("--out", help="folder of the pictures (default: RUN/pictures)")
    parser.add_argument("--format", default="png", choices=("png", "svg"), help="of pictures that stand still")
    parser.add_argument("--rate", type=float, help="frames per second (default: a film of about 12 s)")
    parser.add_argument("--quiet", action="store_true", help="no progress")
    parser.add_argument("--json", action="store_true", help="one JSON object: the files written")
    parser.add_argument("--picture", action="store_true", help="RUN/picture.png and RUN/report.html alone, as at the end of a run")
    return parser.parse_args(arguments)


def drawn(options):
    """Draws what is chosen, and returns the paths, or what to say of them."""
    if options.picture:
        return [at_end(options.run, options.time)]
    study = next(filter(Path.exists, (Path(options.run, name) for name in STUDIES)), None)
    if study and not Path(options.run, "run.json").exists():
        return study_drawn(study, options.out)
    progress = Bar("animation").show if sys.stderr.isatty() and not options.quiet else None
    what = None if options.what == "all" else options.what.split(",")
    paths = pictures(options.run, what, options.time, options.out, options.format, options.rate, progress)
    return [json.dumps({"pictures": [str(path) for path in paths]})] if options.json else paths


def main(arguments=None):
    options = parsed(arguments)
    with warnings.catch_warnings():  # of numbers that no axis can show: the picture is missing, and one line says why
        warnings.simplefilter("ignore", RuntimeWarning)
        return made(lambda: drawn(options))
