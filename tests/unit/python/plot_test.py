#!/usr/bin/python3
"""The pictures, piece by piece, on runs that the C++ writers have written: plot_test.py WRITER PACKAGE_DIRECTORY"""

import contextlib
import io
import json
import subprocess
import sys
import tempfile
import types
import unittest
import unittest.mock
from pathlib import Path

import h5py
import numpy as np
from PIL import Image

WRITER, PACKAGE = sys.argv[1], sys.argv[2]
sys.path.insert(0, PACKAGE)

import matplotlib.pyplot as plt
import polybed
from polybed import plot
from polybed.drawing import animation, curves, history, maps, overview, particles, profiles, style
from polybed.report import beds


class SampleRun(unittest.TestCase):
    """Two species in a column of 60 mm by 200 mm, 18 x 60 cells, five times from 0 to 1 s; see write_sample_run.cpp."""

    kind = 2  # dimensions of fields, or what else write_sample_run writes

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.addCleanup(plt.close, "all")
        self.directory = Path(scratch.name) / "bed-tfm"
        subprocess.run([WRITER, self.directory, str(self.kind)], check=True)
        self.sample = polybed.read(self.directory)

    def assert_drawn(self, *paths):
        for path in paths:
            self.assertGreater(plt.imread(path)[..., :3].std(), 0.05, f"{path.name} is blank")

    def assert_drawn_early(self):
        for name in ("profiles.h5", "history.csv", "run.json"):
            (self.directory / name).unlink()
        self.assert_drawn(plot.picture(self.directory, time=0.5))


class Style(SampleRun):
    def test_the_top_is_a_fifth_above_the_solids(self):
        # the fine layer at 1 s: centred at 0.07 +- 0.006 m, exp(-d^4) * 0.3 > 0.01 for |d| < 1.358 * 0.03 m: up to
        # 0.1166 m, so that the last cell with a centre below is that at 0.115 m, which ends at 35/300 m; a fifth more
        self.assertAlmostEqual(style.shown_height(self.sample, [4]), 0.14, places=12)
        self.assertLessEqual(style.shown_height(self.sample, [0]), style.shown_height(self.sample, range(5)))

    def test_one_scale_for_all_species(self):
        most = max(self.sample.phi_fine[4].max(), self.sample.phi_coarse[4].max())
        group = maps.fractions(self.sample, 4)
        self.assertEqual(group.limits, (0, most))
        self.assertEqual([name for name, _ in group.maps], ["fine", "coarse"])
        self.assertEqual([one.limits for one in maps.thin_apart(group)], [(0, most)])

    def test_what_is_suspended_thinly_has_a_scale_of_its_own(self):
        """The fine species alone, at a hundredth of what is stored: 0.003 at most, over the whole height of the column."""
        bed, silt = self.sample.phi_fine[4], np.full_like(self.sample.phi_fine[4], 0.003)
        group = maps.Group("solids fraction", "viridis", (0, float(bed.max())), [("silt", silt), ("bed", bed)])
        apart = maps.thin_apart(group)
        self.assertEqual([([name for name, _ in one.maps], one.limits) for one in apart], [(["bed"], group.limits), (["silt"], (0, 0.003))])
        run = types.SimpleNamespace(species=["silt", "bed"], faces=self.sample.faces, field=lambda name: [{"phi_silt": silt, "phi_bed": bed}[name]])
        self.assertEqual(style.shown_height(run, [0]), self.sample.faces["y"][-1], "up to where the silt reaches")

    def test_size_classes_are_drawn_as_one(self):
        path = self.directory / "history.csv"
        rows = [line.split(",") for line in path.read_text().split()]
        rows[0] = [name.replace("_fine_", "_sand.1_").replace("_coarse_", "_sand.2_") for name in rows[0]] + ["centre_sand_m"]
        path.write_text("".join(",".join(row if n == 0 else [*row, "0.05"]) + "\n" for n, row in enumerate(rows)))
        stored = {"phi_sand.1": self.sample.phi_fine[4], "phi_sand.2": self.sample.phi_coarse[4]}
        with unittest.mock.patch.object(type(self.sample), "fields", list(stored)), \
                unittest.mock.patch.object(self.sample, "field", lambda name: {4: stored[name]}), \
                unittest.mock.patch.object(self.sample, "fields_at", lambda _, names: {name: stored[name] for name in names}):
            self.assertEqual(self.sample.kinds, {"sand": ["sand.1", "sand.2"]})
            (name, drawn), = maps.fractions(self.sample, 4, classes=False).maps
        np.testing.assert_array_equal(drawn, sum(stored.values()))

    def test_each_of_many_species_looks_different(self):
        looks = {tuple(style.species_line(n).values()) for n in range(15)}  # as many as a case may have
        self.assertEqual(len(looks), 15)

    def test_the_title_tells_what_is_not_done(self):
        self.assertNotIn("done", style.title_of(self.sample, 0.5))
        path = self.directory / "run.json"
        path.write_text(json.dumps(json.loads(path.read_text()) | {"state": "failed: the step is too small"}))
        self.assertIn("failed", style.title_of(self.sample, 0.5))
        self.assertIn("t = 0.5 s", style.title_of(self.sample, 0.5))


class Fields(SampleRun):
    def test_velocities_have_a_symmetric_scale_with_units(self):
        group = maps.velocities(self.sample, 4)
        self.assertEqual(group.limits[0], -group.limits[1])
        # the sample's fluid rises with its height in m/s: 0.1983 m/s in the topmost cell, two digits of it
        self.assertEqual(group.limits[1], 200)
        self.assertIn("(mm/s)", group.label)

    def test_maps_keep_the_aspect_of_the_column(self):
        with plt.rc_context(style.STYLE):
            figure = maps.draw(self.sample, 4)
        drawn = [axes for axes in figure.axes if axes.get_xlabel().startswith("x")]
        self.assertEqual([axes.get_title() for axes in drawn], ["fine", "coarse", "fluid", "fluid"])
        for axes in drawn:
            self.assertEqual(axes.get_aspect(), 1)
            box = axes.get_window_extent()
            # 60 mm by 140 mm shown; a pixel of rounding
            self.assertAlmostEqual(box.height / box.width, 140 / 60, delta=0.02)
        self.assertEqual(drawn[0].get_ylabel(), "y (mm)")

    def test_rows_fill_up_and_go_on(self):
        groups = [maps.Group("", "viridis", (0, 1), [("", None)] * n) for n in (3, 1, 4)]
        self.assertEqual(maps.wrapped(groups, 0.8), [groups])
        self.assertEqual(maps.wrapped(groups, 2.3), [groups[:2], groups[2:]])
        self.assertEqual(maps.wrapped(groups, 9), [[g] for g in groups])


class Profiles(SampleRun):
    def test_rows_in_time_begin_and_end_with_the_run(self):
        np.testing.assert_array_equal(profiles.edges(np.array([0, 1, 3.0])), [0, 0.5, 2, 3])
        self.assertEqual(len(profiles.edges(np.array([2.0]))), 2)

    def test_what_is_drawn_is_what_is_stored(self):
        figure = profiles.draw(self.sample, 0.6)  # 0.5 s is nearest
        lines = {line.get_label(): line for line in figure.axes[0].get_lines()}
        np.testing.assert_array_equal(lines["fine"].get_xdata(), self.sample.profiles["phi_fine"][2])
        self.assertAlmostEqual(lines["bed height"].get_ydata()[0], 90)  # 0.08 + 0.02 * 0.5 m, in mm
        self.assertNotIn("interface", lines, "the sample has none")

    def test_a_level_that_the_table_of_measures_names_is_drawn(self):
        with unittest.mock.patch.dict(style.LEVELS, {"centre_fine_m": "new level"}):
            for figure in (profiles.draw(self.sample, 0.6), history.draw(self.sample)):
                lines = {line.get_label(): line for line in figure.axes[0].get_lines()}
                self.assertEqual((lines["bed height"].get_linestyle(), lines["new level"].get_linestyle()), ("--", "-."))

    def test_no_value_is_none(self):
        self.assertIsNone(profiles.value_at(self.sample, "interface_m", 0.5))
        self.assertIsNone(profiles.value_at(self.sample, "no such column", 0.5))


class History(SampleRun):
    def test_the_balance_is_of_forces(self):
        path = self.directory / "history.csv"
        rows = path.read_text().strip().split("\n")
        rows = [rows[0] + ",pressure_drop_Pa,buoyant_weight_Pa"] + [f"{row},{3 * n},{n and 2}" for n, row in enumerate(rows[1:])]
        path.write_text("\n".join(rows) + "\n")
        figure = history.draw(self.sample)
        axes = next(a for a in figure.axes if "weight" in a.get_ylabel())
        drawn = axes.get_lines()[1].get_ydata()
        self.assertTrue(np.isnan(drawn[0]), "no weight, no ratio")
        np.testing.assert_array_equal(drawn[1:], [1.5, 3, 4.5, 6])

    def test_an_invariant_that_did_not_hold_stands_out(self):
        path = self.directory / "run.json"
        invariants = [{"name": "mass", "worst": 1e-14, "limit": 1e-12}, {"name": "divergence", "worst": 0.5, "limit": 1e-2}]
        path.write_text(json.dumps(json.loads(path.read_text()) | {"invariants": invariants}))
        figure, axes = plt.subplots()
        history.draw_invariants(axes, self.sample)
        colours = [bar.get_facecolor() for bar in axes.patches]
        self.assertEqual(len(colours), 2)
        self.assertNotEqual(colours[0], colours[1])
        self.assertGreater(axes.get_xlim()[1], 50, "the bar beyond the limit is shown whole")


class Film(SampleRun):
    def test_rates_and_titles(self):
        self.assertEqual([animation.rate_of(n) for n in (1, 120, 10000)], [2, 10, 25])
        self.assertEqual(animation.digits_of(np.array([0, 0.25, 0.5])), ".1f")
        self.assertEqual(animation.digits_of(np.array([0, 0.01, 1])), ".2f")
        self.assertEqual(animation.digits_of(np.array([0, 20.0])), ".0f")
        self.assertEqual(animation.digits_of(np.array([0.0])), ".0f")

    def test_every_stored_time_is_a_frame(self):
        seen = []
        path = animation.film(self.sample, self.directory / "film.gif", progress=lambda *n: seen.append(n))
        self.assertEqual(seen, [(n, 5) for n in range(1, 6)])
        with Image.open(path) as image:
            self.assertEqual(image.n_frames, 5)
        self.assertEqual([p.name for p in self.directory.glob("unfinished-*")], [])

    @unittest.skipUnless(animation.has_ffmpeg(), "ffmpeg is not installed")
    def test_ffmpeg_makes_an_mp4(self):
        path = animation.film(self.sample, self.directory / "film.mp4")
        self.assertEqual(path.read_bytes()[4:8], b"ftyp")


class Whole(SampleRun):
    def test_a_time_that_is_not_stored_is_refused(self):
        with self.assertRaisesRegex(plot.StudyError, "from 0 to 1 s"):
            plot.step_of(self.sample, 1.5)
        self.assertEqual([plot.step_of(self.sample, t) for t in (None, 0, 0.6, 1)], [4, 0, 2, 4])

    def test_all_pictures_and_nothing_else(self):
        paths = plot.pictures(self.directory, plot.kinds_of(self.sample)[:-1], time=0.5)
        self.assertEqual(sorted(p.name for p in (self.directory / "pictures").iterdir()), sorted(p.name for p in paths))
        self.assert_drawn(*paths)

    def test_the_picture_at_the_end_needs_fields_alone(self):
        self.assert_drawn_early()
        with tempfile.TemporaryDirectory() as empty:
            self.assertEqual(plot.main([empty]), 4)

    def test_words(self):
        with contextlib.redirect_stdout(io.StringIO()) as out, contextlib.redirect_stderr(io.StringIO()) as err:
            self.assertEqual(plot.main([str(self.directory), "--what", "overview", "--json"]), 0)
            self.assertEqual(plot.main([str(self.directory), "--time", "7"]), 2)
            self.assertEqual(plot.main([str(self.directory), "--what", "films"]), 2)
        self.assertEqual(json.loads(out.getvalue()), {"pictures": [str(self.directory / "pictures/overview.png")]})
        self.assertIn("films", err.getvalue())


class AroundAxis(SampleRun):
    """The sample as if 60 mm were the radius of a tube that widens from half of it."""

    def setUp(self):
        super().setUp()
        path = self.directory / "run.json"
        case = 'jet = [{from = [0.01], to = [0.02]}]\n[column]\nshape = "axisymmetric"\nprofile = [[0, 0.06], [0.2, 0.12]]'
        path.write_text(json.dumps(json.loads(path.read_text()) | {"case": case}))
        self.sample = polybed.read(self.directory)

    def test_pictures_and_page_go_from_wall_to_wall(self):
        figure, meshes = maps.draw_maps(self.sample, [maps.fractions(self.sample, 4)], "", 0.14)
        axes = figure.axes[0]
        self.assertEqual(axes.get_xlim(), (-60, 60))
        self.assertTrue(axes.get_xlabel().startswith("r"))
        self.assertEqual([tuple(line.get_xdata()) for line in axes.lines], [(-30, -60), (30, 60), (10, 20), (-10, -20)])
        self.assertEqual([text.get_text() for text in axes.texts], ["jet1"])
        phi = self.sample.phi_fine[4]
        np.testing.assert_array_equal(meshes[0][0].get_array().reshape(60, 36), np.hstack([phi[:, ::-1], phi]))
        on_page = beds.maps_of(self.sample)
        self.assertEqual((on_page["nx"], on_page["size"][0]), (36, 120))
        self.assertIn("both sides", on_page["note"])

    def test_nothing_is_shown_beyond_the_wall(self):
        self.sample._stored()["open"] = np.tile(np.arange(18) < 17, (60, 1)).astype(float)
        shown = style.as_shown(self.sample, self.sample.phi_fine[4])
        np.testing.assert_array_equal(np.flatnonzero(shown.mask.all(axis=0)), [0, 35])
        self.assertTrue(beds.maps_of(self.sample))


class Whole3D(Whole):
    kind = 3

    def test_the_plane_at_half_depth_is_shown(self):
        phi = self.sample.phi_fine[4]
        np.testing.assert_array_equal(style.in_plane(phi), phi[2])  # of four cells in depth
        self.assertIn("half depth", style.title_of(self.sample, 1, maps=True))
        self.assertTrue(overview.draw(self.sample, 4).axes)


class Particles(SampleRun):
    """300 particles of 2 and 4 mm diameter on a lattice, one fewer at each time; see write_sample_run.cpp."""

    kind = "particles"

    def test_circles_have_the_size_of_the_particles(self):
        views = particles.views_of(self.sample, [0])
        views.show(0)
        for axes, drawn in zip(views.axes, views.drawn):
            self.assertEqual(axes.get_aspect(), 1)
            views.figure.canvas.draw()
            transforms = drawn.get_transforms()
            pixels = axes.transData.transform([[1, 0], [0, 0]])
            millimetre = pixels[0, 0] - pixels[1, 0]
            outline = drawn.get_paths()[0].get_extents().width
            diameters = outline * transforms[:, 0, 0] * drawn.get_transform().get_matrix()[0, 0] / millimetre
            order = particles.front(self.sample.particles[0])
            # each circle's diameter in mm, within rounding of the figure's size in pixels
            np.testing.assert_allclose(diameters, 2e3 * self.sample.particles[0].radius[order], rtol=1e-6)
            self.assertEqual(drawn.get_offsets().tolist(), (1e3 * self.sample.particles[0].position[order, :2]).tolist())

    def test_an_empty_hopper_is_shown_while_it_runs_out(self):
        with unittest.mock.patch.object(self.sample.particles, "count", np.array([300, 200, 150, 20, 0])):
            self.assertEqual(plot.step_of(self.sample, None), 2, "the last with half of them")
        self.assertEqual(plot.step_of(self.sample, None), 4)

    def test_those_behind_come_first(self):
        step = self.sample.particles[0]
        depth = step.position[particles.front(step), 2]
        self.assertTrue((np.diff(depth) >= 0).all())

    def test_too_many_are_thinned_to_the_front_and_told(self):
        step = self.sample.particles[0]
        self.assertEqual(particles.thinned(self.sample, step), "")
        chosen = particles.front(step, 150)
        self.assertEqual(sorted(chosen), list(range(150, 300)))  # the front layer of two, at a depth of 6 of 8 mm
        self.assertEqual(particles.thinned(self.sample, step, 150),
                         "150 of 300 particles: those within 2 mm of the front")

    def test_colours_tell_species_and_speed(self):
        step = self.sample.particles[0]
        colours = particles.species_colours(self.sample, step)
        self.assertEqual(set(colours[step.of("fine")]), {style.COLOURS[0]})
        self.assertEqual(set(colours[step.of("coarse")]), {style.COLOURS[1]})
        np.testing.assert_allclose(particles.speed(step), 20)  # mm/s
        self.assertEqual(particles.fastest([step]), (20, False))
        step.velocity[7] = [3, 4, 0]  # one of 300 is much faster: it is beyond the scale, and the scale says so
        self.assertEqual(particles.fastest([step]), (20, True))
        step.velocity[:] = [0.0, 0.1234, 0.0]
        self.assertEqual(particles.fastest([step]), (130, False), "rounded up: what is shown within the scale is")
        self.assertEqual(particles.fastest([]), (1e-3, False))

    def test_joined_sides_show_the_rest_of_what_they_cut(self):
        self.sample.particles.periodic[0] = True
        number, shift = particles.images(self.sample, np.array([0.0005, 0.03, 0.0595]), np.full(3, 0.001))
        self.assertEqual(number.tolist(), [0, 0, 1, 2, 2])
        np.testing.assert_array_equal(shift, [0, 0.06, 0, 0, -0.06])
        self.sample.particles.periodic[0] = False
        self.assertEqual(len(particles.images(self.sample, np.array([0.0005]), np.array([0.001]))[0]), 1)

    def test_the_top_is_a_fifth_above_the_highest(self):
        # at 1 s a fine one at 2 + 19 * 4 + 20 mm with a radius of 1 mm: 99 mm
        self.assertAlmostEqual(particles.shown_top(self.sample, [4]), 1.2 * 0.099, places=12)

    def test_the_ledger_shows_what_does_not_close(self):
        def ledger(run):
            return {line.label: line.y for line in curves.ledger(run)[0].lines}

        lines = ledger(self.sample)
        # the sample's numbers: kinetic falls by 2 J/s, elastic by 1 J/s, 3 J/s are dissipated
        np.testing.assert_allclose(lines["stored"], -3 * self.sample.particles.time)
        np.testing.assert_allclose(lines["does not close"], 0, atol=1e-14)
        table = self.sample.history
        table["dissipated_J"][-1] += 0.5
        run = types.SimpleNamespace(history=table)
        self.assertAlmostEqual(ledger(run)["does not close"][-1], 0.5, places=14)
        table["carried_out_J"] = np.where(np.arange(len(table["time_s"])) == len(table["time_s"]) - 1, -0.5, 0)
        lines = ledger(run)
        self.assertEqual(lines["carried out"][-1], -0.5)
        np.testing.assert_allclose(lines["does not close"], 0, atol=1e-14)

    def test_a_history_that_grows_while_it_is_drawn(self):
        path, whole_lines = self.directory / "history.csv", polybed.read.__globals__["whole_lines"]
        last = path.read_text().splitlines()[-1].split(",")

        def grown(file):
            if file == path:
                last[0] = repr(float(last[0]) + 1)
                path.write_text(path.read_text() + ",".join(last) + "\n")
            return whole_lines(file)

        with unittest.mock.patch.dict(polybed.read.__globals__, whole_lines=grown):
            paths = plot.pictures(self.directory, ("history",))
        self.assertEqual([p.name for p in paths], ["history.png"])

    def test_temperature_stands_where_there_is_no_pressure(self):
        figure = profiles.draw(self.sample, 1)
        labels = [axes.get_xlabel() for axes in figure.axes]
        self.assertTrue(any(label.startswith("granular temperature") for label in labels))
        self.assertFalse(any("pressure" in label for label in labels))

    def test_all_pictures_and_no_fields(self):
        paths = plot.pictures(self.directory)
        self.assertEqual([path.stem for path in paths], ["overview", "particles", "profiles", "history", "animation"])
        self.assert_drawn(*paths[:4])
        with Image.open(paths[4]) as film:
            self.assertEqual(film.n_frames, 5)
        with contextlib.redirect_stderr(io.StringIO()) as err:
            self.assertEqual(plot.main([str(self.directory), "--what", "fields"]), 2)
        self.assertIn("holds no fields; there are overview, particles", err.getvalue())

    def test_the_picture_at_the_end_needs_particles_alone(self):
        self.assert_drawn_early()

    def test_a_step_without_particles_is_drawn(self):
        with h5py.File(self.directory / "particles/000005.h5", "r+") as file:
            for name in list(file["step"]):
                empty = file["step"][name][:0]
                del file["step"][name]
                file["step"][name] = empty
        with h5py.File(self.directory / "particles.h5", "r+") as file:
            file["particles"][4] = 0
        self.assert_drawn(plot.picture(self.directory))
        self.assertEqual(len(plot.pictures(self.directory, ["particles", "animation"])), 2)


class FieldsAndParticles(SampleRun):
    kind = "coupled"

    def test_all_pictures(self):
        paths = plot.pictures(self.directory, plot.kinds_of(self.sample)[:-1], time=0.5)
        self.assertEqual([path.stem for path in paths], ["overview", "fields", "particles", "profiles", "history"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
