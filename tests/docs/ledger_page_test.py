"""tools/make-ledger-page: docs/claims.md read strictly, figures and ids from results, and a page that cannot go stale."""

import json
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path.insert(0, str(PROJECT / "tools"))
from pages.ledger import LedgerError, markdown, read_ledger
from pages.small_svg import small_svg

HEAD = "# Claims\n\nAn introduction.\n\n"
CLAIM = {"place": "(3.8), Example 3.1", "statement": "it | falls * 2", "printed": "", "measured": "`0.1` < 1",
         "verdict": "holds-as-corrected", "why": "once"}


def page_of(change=lambda text: text):
    from pages.ledger import Entry
    other = CLAIM | {"statement": "it rises", "verdict": "holds", "why": ""}
    return change(HEAD + markdown([Entry("3.1", "A monobot", "", [CLAIM, other], ["figures/fig-3.3.svg"]),
                                   Entry("3.2", "Car park", "no recording", [], [])]))


class ReadLedger(unittest.TestCase):
    def test_reads_what_reproduce_writes(self):
        first, second = read_ledger(page_of(), "claims.md")
        self.assertEqual(first.claims[0], CLAIM)
        self.assertEqual((first.id, first.title, first.figures), ("3.1", "A monobot", ["figures/fig-3.3.svg"]))
        self.assertEqual((second.skipped, second.claims), ("no recording", []))

    def test_reads_the_whole_ledger(self):
        entries = read_ledger((PROJECT / "docs" / "claims.md").read_text(), "claims.md")
        self.assertGreater(sum(len(entry.claims) for entry in entries), 300)

    def test_refuses_anything_else_and_says_where(self):
        changes = {
            "a verdict that is none": ("| holds as corrected | once", "| holds perhaps | once", "holds-perhaps"),
            "a column too few": ("|  | `0.1`".replace("`", "\\`"), "| \\`0.1\\`", "5 columns"),
            "a wrong count": ("| holds | 1 |", "| holds | 2 |", "claims.md:7"),
            "a line in between": ("\n\nFigures", "\n\nA remark.\n\nFigures", "not as `incognita reproduce` writes it"),
            "an unescaped star": ("\\* 2", "* 2", "not as"),
            "a figure elsewhere": ("figures/fig-3.3.svg", "../fig-3.3.svg", "not as"),
        }
        for name, (old, new, message) in changes.items():
            with self.subTest(name):
                self.assertIn(old, page_of())
                with self.assertRaises(LedgerError) as raised:
                    read_ledger(page_of(lambda text: text.replace(old, new)), "claims.md")
                self.assertIn(message, str(raised.exception))


class SmallSvg(unittest.TestCase):
    def test_lines_become_relative_tenths(self):
        self.assertEqual(small_svg("<path stroke='a'  d='M10.04,20.00 L10.00,20.04 L12.51,19.00 M1.00,1.00 L1.50,1.00  '/>"),
                         "<path stroke='a'  d='M10,20l0,0 2.5,-1M1,1l.5,0'/>")

    def test_rounding_does_not_add_up(self):
        points = " ".join(f"L{0.04 * i:.2f},0.00" for i in range(1, 1001))
        steps = small_svg(f"<path d='M0.00,0.00 {points}'/>").split("l")[1].split("'")[0].split(" ")
        self.assertAlmostEqual(sum(float(step.split(",")[0]) for step in steps), 40.0, places=6)

    def test_areas_and_groups(self):
        self.assertEqual(small_svg("<polygon fill = 'a' points = '1.00,1.00 2.00,1.00 2.00,3.00'/>"),
                         "<path fill = 'a' d='M1,1l1,0 0,2z'/>")
        self.assertEqual(small_svg("<g a=\"1\">\n</g><g b=\"1\"><text>x</text></g>"), "<g b=\"1\"><text>x</text></g>")
        line = "<path stroke='{}'  d='M1.00,1.00 L2.00,1.00  '/>"
        three = "".join(f'<g b="1">{line.format(color)}</g>' for color in "rrb")
        self.assertEqual(small_svg(three), '<g b="1">' + "<path stroke='r'  d='M1,1l1,0M1,1l1,0'/>" +
                         "<path stroke='b'  d='M1,1l1,0'/></g>")

    def test_curves_stay(self):
        curve = "<path d='M1.00,1.00 C2,2 3,3 4,4'/>"
        self.assertEqual(small_svg(curve), curve)


class Page(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.project = Path(self.scratch.name) / "project"
        for folder in ("tools", "web"):
            shutil.copytree(PROJECT / folder, self.project / folder)
        (self.project / "docs").mkdir()
        (self.project / "docs" / "claims.md").write_text(page_of())
        self.out = Path(self.scratch.name) / "out"

    def tearDown(self):
        self.scratch.cleanup()

    def tool(self, *arguments):
        return subprocess.run([sys.executable, self.project / "tools" / "make-ledger-page", *map(str, arguments)],
                              capture_output=True, text=True)

    def results(self, **change):
        folder = Path(self.scratch.name) / "results"
        (folder / "figures").mkdir(parents=True, exist_ok=True)
        (folder / "figures" / "fig-3.3.svg").write_text("<svg><path d='M1.00,1.00 L2.00,2.00'/></svg>")
        claims = [{"id": f"3.1-{i}", "runs": 20, "least_runs": 5} | claim for i, claim in
                  enumerate(read_ledger(page_of(), "claims.md")[0].claims)]
        claims[0] |= change
        (folder / "claims.json").write_text(json.dumps([{"id": "3.1", "title": "", "claims": claims, "figures": []}]))
        return folder

    def made(self):
        return json.loads((self.out / "claims.json").read_text())

    def test_without_results_ids_are_words_and_figures_are_named(self):
        self.assertEqual(self.tool(self.out).returncode, 0)
        entry = self.made()[0]
        self.assertEqual([claim["id"] for claim in entry["claims"]], ["3.1-it-falls-2", "3.1-it-rises"])
        self.assertEqual(entry["figures"], [{"id": "fig-3.3", "file": "", "data": ""}])
        self.assertNotIn("runs", entry["claims"][0])
        self.assertEqual(self.tool("--check", self.out).returncode, 0)

    def test_results_give_ids_runs_and_figures_which_stay(self):
        self.assertEqual(self.tool(self.out, self.results()).stdout, "")
        for _ in range(2):
            claim = self.made()[0]["claims"][0]
            self.assertEqual((claim["id"], claim["runs"], claim["least_runs"]), ("3.1-0", 20, 5))
            self.assertEqual(self.made()[0]["figures"][0]["file"], "figures/fig-3.3.svg")
            self.assertIn("M1,1l1,1", (self.out / "figures" / "fig-3.3.svg").read_text())
            self.assertEqual(self.tool("--check", self.out).returncode, 0)
            self.assertEqual(self.tool(self.out).returncode, 0)

    def test_figures_of_other_results_are_not_taken(self):
        self.assertIn("3.1: 1 of 2 claims differ", self.tool(self.out, self.results(verdict="holds")).stdout)
        self.assertEqual(self.made()[0]["figures"][0]["file"], "")
        self.assertNotIn("runs", self.made()[0]["claims"][0])
        self.assertEqual(self.made()[0]["claims"][0]["id"], "3.1-0")

    def test_large_figures_are_left_out(self):
        self.assertIn("is left out", self.tool("--largest-figure", "10", self.out, self.results()).stdout)
        self.assertEqual(list((self.out / "figures").iterdir()), [])

    def test_check_finds_each_way_to_be_stale(self):
        self.tool(self.out, self.results())
        def stale(path, text):
            old = path.read_text() if path.exists() else None
            path.write_text(text)
            result = self.tool("--check", self.out)
            path.write_text(old) if old is not None else path.unlink()
            self.assertEqual(result.returncode, 1, path)
            return result.stderr
        changed = page_of(lambda text: text.replace("it rises", "it soars"))
        self.assertIn("claims.json is not up to date", stale(self.project / "docs" / "claims.md", changed))
        self.assertIn("claims/search.js is not up to date", stale(self.project / "web/laboratory/claims/search.js", "//"))
        self.assertIn("claims/new.js is missing", stale(self.project / "web/laboratory/claims/new.js", "//"))
        self.assertIn("index.html is not up to date", stale(self.out / "index.html", "x"))
        self.assertIn("old.js does not belong there", stale(self.out / "old.js", "x"))
        self.assertIn("figures/fig-9.svg does not belong there", stale(self.out / "figures" / "fig-9.svg", "x"))
        self.assertEqual(self.tool("--check", self.out).returncode, 0)

    def test_every_address_in_the_page_exists_in_the_folder(self):
        self.tool(self.out, self.results())
        import re
        page = (self.out / "index.html").read_text()
        for address in re.findall(r'(?:href|src)="([^"#:]+)"', page):
            self.assertTrue((self.out / address).is_file(), address)
        for module in self.out.rglob("*.js"):
            for address in re.findall(r'from "([^"]+)"', module.read_text()):
                self.assertTrue((module.parent / address).is_file(), f"{module}: {address}")

    def test_refuses_results_that_are_none(self):
        folder = self.results()
        (folder / "claims.json").write_text('{"scenario": "room"}')
        result = self.tool(self.out, folder)
        self.assertEqual(result.returncode, 2)
        self.assertIn("is not what `incognita reproduce` writes", result.stderr)
        self.assertEqual(self.tool(self.out, folder / "absent").returncode, 2)


if __name__ == "__main__":
    unittest.main()
