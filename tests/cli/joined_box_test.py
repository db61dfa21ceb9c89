#!/usr/bin/python3
"""The case periodic-box: what check foresees, both models measure. Usage: joined_box_test.py PROGRAM"""
import json

from program import DONE, ROOT, WRONG_CASE, Scratch, history, main, strict_json

CASE = ROOT / "cases/periodic-box/case.toml"


class JoinedBox(Scratch):
    def card(self, model, *words):
        self.ends(DONE, model, CASE, "--quiet", "--no-picture", "-o", self.folder / model, *words)
        return json.loads((self.folder / model / "run.json").read_text())["card"]

    def expected(self):
        return strict_json(self.ends(DONE, "check", CASE, "--json").stdout)["expected"]

    def test_a_continuum_has_the_slips_of_its_law(self):
        """The suspension stays even but for its start, 1e-3 of the fractions at random, and rtol is 1e-3."""
        expected, card = self.expected(), self.card("tfm")
        for name, slip in expected["slip_m_s"].items():
            self.assertAlmostEqual(card["slip_m_s"][name]["value"] / slip, 1, delta=2e-3)
        self.assertAlmostEqual(card["superficial_slip_m_s"]["value"] / expected["superficial_slip_m_s"], 1, delta=2e-3)
        self.assertAlmostEqual(card["pressure_gradient_Pa_m"] / expected["pressure_gradient_Pa_m"], 1, delta=1e-12)

    def test_particles_have_them_in_the_mean(self):
        """18 coarse ones in 8 cells: the fractions that they see differ by a tenth, and the slips by half of that."""
        expected, card = self.expected(), self.card("dem", "--until", "2 s")
        for name, slip in expected["slip_m_s"].items():
            self.assertAlmostEqual(card["slip_m_s"][name]["value"] / slip, 1, delta=0.06)
        self.assertAlmostEqual(card["superficial_slip_m_s"]["value"] / expected["superficial_slip_m_s"], 1, delta=0.03)
        self.assertLess(abs(card["mass_velocity_m_s"]), 1e-15)

    def test_the_models_are_compared_by_their_slips(self):
        words = ["compare", CASE, "-o", self.folder / "both", "--until", "0.2 s", "--quiet", "--no-picture", "--json"]
        found = strict_json(self.ends(DONE, *words).stdout)
        self.assertEqual(list(found["scores"]), ["e_slip", "order"])
        slip = found["measures"]["superficial_slip_m_s"]
        self.assertAlmostEqual(found["scores"]["e_slip"]["value"], slip["tfm"] / slip["dem"] - 1, delta=1e-12)
        self.assertEqual(list(found["measures"]), ["superficial_slip_m_s", "slip_fine_m_s", "slip_coarse_m_s", "pressure_gradient_Pa_m"])

    def test_studies_of_a_bed_are_refused(self):
        for words in (["cost", CASE], ["inversion", CASE, "--scan", "tfm", "--from", "10 mm/s", "--to", "20 mm/s"],
                      ["tfm", CASE, "--closure-uncertainty", "--until", "0.1 s", "--no-picture"]):
            told = self.ends(WRONG_CASE, *words, "-o", self.folder / words[0], "--quiet").stderr
            self.assertIn('has no height and no inlet; polybed compare gives its slips', told)

    def test_no_slip_is_foreseen_or_measured_that_is_not_known(self):
        """check solves the balance of form A alone, and a species without particles has no slip."""
        expected = strict_json(self.ends(DONE, "check", CASE, "--json", "--set", 'tfm.form="B"').stdout)["expected"]
        self.assertIsNone(expected["superficial_slip_m_s"])
        card = self.card("dem", "--until", "0.01 s", "--set", "bed.particles=[0,18]", "--set", "bed.solids_fraction=0.6")
        self.assertEqual(list(card["slip_m_s"]), ["coarse"])

    def test_nothing_is_read_from_a_bottom(self):
        card = self.card("tfm", "--until", "0.1 s")
        self.assertIsNone(card["bed_height_m"])
        self.assertIsNone(card["state"])
        self.assertEqual(set(history(self.folder / "tfm")["bed_height_m"]), {None})
        measured = strict_json(self.ends(DONE, "measure", self.folder / "tfm", "--json").stdout)
        self.assertEqual({value for measure in measured["measures"].values() for value in measure["values"]}, {None})
        self.assertIn("--until steady waits", self.ends(WRONG_CASE, "tfm", CASE, "--until", "steady", "-o", self.folder / "x").stderr)


if __name__ == "__main__":
    main()
