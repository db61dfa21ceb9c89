"""The volume fractions, or the particles, over the stored times, as MP4 where ffmpeg is there, else as GIF by Pillow."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib import animation

from polybed.drawing.maps import Group, draw_maps, voidages
from polybed.drawing.particles import views_of
from polybed.drawing.style import as_shown, fitted, greatest_fraction, in_plane, shown_height, title_of
from polybed.files import in_place
from polybed.runner import found_program

LENGTH = 12  # s, about what a film lasts
RATES = (2, 25)  # frames per second, least and most


def rate_of(frames):
    """Frames per second that make a film of the usual length."""
    return int(np.clip(round(frames / LENGTH), *RATES))


def writer(path, rate):
    """What writes a file of this ending; MP4 with even sizes and the pixel format that every player knows."""
    if path.suffix == ".gif":
        return animation.PillowWriter(fps=rate)
    even = "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white"
    return animation.FFMpegWriter(fps=rate, codec="libx264", extra_args=["-pix_fmt", "yuv420p", "-vf", even])


def digits_of(times):
    """Format of a time such that titles keep their length from frame to frame."""
    finest = np.diff(times).min() if len(times) > 1 else 1.0
    return f".{max(0, int(np.ceil(-np.log10(finest) - 1e-9)))}f"


def has_ffmpeg():
    """Whether MP4 can be made."""
    return found_program("ffmpeg") is not None


def field_frames(run):
    """The volume fractions of the species and of the fluid: the figure, and what draws the frame of a number."""
    steps, digits = range(len(run.time)), digits_of(run.time)
    most = greatest_fraction(run, steps)
    maps = [(name, in_plane(run.field(f"phi_{name}")[0])) for name in run.species]
    void = voidages(run, int(np.argmin([run.field("voidage")[n].min() for n in steps])))
    void.maps = [("fluid", in_plane(run.field("voidage")[0]))]
    groups = [Group("solids fraction", "viridis", (0, most), maps), void]
    first_title = title_of(run, run.time[0], maps=True, digits=digits)
    figure, meshes = draw_maps(run, groups, first_title, shown_height(run, steps))
    names = [f"phi_{name}" for name in run.species] + ["voidage"]
    flat = [mesh for group in meshes for mesh in group]
    title = figure._suptitle

    def show(step):
        for mesh, name in zip(flat, names):
            mesh.set_array(as_shown(run, in_plane(run.field(name)[step])).ravel())
        title.set_text(fitted(title_of(run, run.time[step], maps=True, digits=digits), figure, 10))

    return figure, show


def film(run, path, rate=None, progress=None):
    """Writes the film to a path that ends in .mp4 or .gif. progress: called with the numbers of frames done and in all"""
    if count := len(run.particles):
        views, digits = views_of(run, range(count)), digits_of(run.particles.time)
        figure, show = views.figure, lambda step: views.show(step, digits)
    else:
        (figure, show), count = field_frames(run), len(run.time)
    found = {"animation.ffmpeg_path": found_program("ffmpeg") or "ffmpeg"}
    # The writer knows the kind of film by the ending.
    try:
        with in_place(path, ".temporary" + path.suffix) as temporary, plt.rc_context(found):
            film_writer = writer(path, rate or rate_of(count))
            with film_writer.saving(figure, str(temporary), dpi=110):
                for step in range(count):
                    show(step)
                    film_writer.grab_frame()
                    if progress:
                        progress(step + 1, count)
    finally:
        plt.close(figure)
    return path
