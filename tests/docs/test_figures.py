"""figures.py finds figures that are wrong, and only those."""

import tempfile
import unittest
from pathlib import Path

import figures


class Figures(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        (self.root / "docs").mkdir()
        (self.root / "README.md").write_text("# A page\n")
        (self.root / "errors.csv").write_text("form,rms\ncubic,0.019749\nnotes,-0.0738\nlinks,1.284e-4\nscale,12.5\n")
        (self.root / "shares.csv").write_text("share\n0.4731\n")

    def faults(self, text, files="errors.csv"):
        """What is wrong with a page that marks the text."""
        (self.root / "docs" / "page.md").write_text(f"# Figures\n\n<!-- figures: {files} -->\n{text}\n<!-- /figures -->\n")
        return figures.check_pages(self.root)[0]

    def test_figures_that_are_there(self):
        self.assertEqual(self.faults("errs by .0197, or 0.020, or 0.02; | .0738 | −.074 |, 12.5"), [])
        self.assertEqual(self.faults("1.3 · 10⁻⁴, 1.28e-4, .00013"), [])

    def test_a_wrong_figure_is_found(self):
        self.assertEqual(self.faults("errs by .0198"), ["docs/page.md:4: .0198 is not in errors.csv"])
        self.assertEqual(self.faults("right: .0197\nand | .0738 | .0739 |"), ["docs/page.md:5: .0739 is not in errors.csv"])
        self.assertEqual(len(self.faults("1.2 · 10⁻⁴, 1.28e-5, 0.0200")), 3)

    def test_data_that_changed_are_found(self):
        self.assertEqual(self.faults("notes .0738"), [])
        (self.root / "errors.csv").write_text("form,rms\nnotes,0.0751\n")
        self.assertEqual(len(figures.check_pages(self.root)[0]), 1)

    def test_percentages(self):
        self.assertEqual(self.faults("47 %, 47.3%, 12.5 %, 1.97 %", "errors.csv, shares.csv"), [])
        self.assertEqual(len(self.faults("48 %, 47.4 %", "errors.csv, shares.csv")), 2)

    def test_what_is_no_figure(self):
        self.assertEqual(self.faults("43 cases of 3.25.0, `--error 0.3`, v1.2x\n```sh\nheightlight --relief 0.7\n```"), [])

    def test_marks(self):
        self.assertIn("absent.csv: cannot be read", self.faults(".0197", "errors.csv, absent.csv")[0])
        self.assertIn("within figures", self.faults("<!-- figures: errors.csv -->\n.0197")[0])
        self.assertIn("did not begin", self.faults("<!-- /figures -->")[0])
        (self.root / "README.md").write_text("# A page\n<!-- figures: errors.csv --> .0197\n")
        self.assertIn("README.md:2: its figures have no end", figures.check_pages(self.root)[0][0])

    def test_figures_outside_of_marks(self):
        text = "9.99 <!-- figures: errors.csv --> .0197 <!-- /figures --> 9.98, `<!-- figures: FILE -->` marks them\n"
        (self.root / "README.md").write_text(text)
        self.assertEqual(figures.check_pages(self.root), ([], 1))


if __name__ == "__main__":
    unittest.main()
