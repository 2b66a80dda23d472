"""tools/make-ledger-page: claims and figures from results, and a page that cannot go stale."""

import json
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path.insert(0, str(PROJECT / "tools"))
from pages.ledger_page import FIELDS
from pages.small_svg import small_svg

CLAIM = {name: "x" for name in FIELDS} | {"finding": "holds", "verdict": "holds", "runs": 20, "least_runs": 5}
FIGURE = {"id": "fig-3.3", "file": "figures/fig-3.3.svg", "data": "figures/fig-3.3.csv"}


def ledger(**change):
    return [{"id": "3.1", "title": "A monobot", "claims": [CLAIM | change], "figures": [FIGURE]},
            {"id": "3.2", "title": "Car park", "skipped": "no recording", "claims": [], "figures": []}]


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

    def test_what_groups_share_is_stated_once(self):
        lines = '<g fill="none" color="{}" stroke="currentColor" stroke-linecap="round" stroke-linejoin="round">'
        texts = '<g transform="translate(1,2)" fill="rgb(51, 0,255)" font-family="DejaVu Sans" font-size="{}">'
        self.assertEqual(
            small_svg('<g id="gnuplot_canvas">\n' + lines.format("black") + "\n\t" + texts.format("13.00") +
                      "<text> a  b </text>\n</g></g>" + lines.format("#FFFFFF") + texts.format("9") + "<text>c</text></g></g></g>"),
            '<g id="gnuplot_canvas" fill="none" color="black" stroke="currentColor" stroke-linecap="round" stroke-linejoin="round" '
            'font-family="DejaVu Sans" font-size="13.00">'
            '<g><g transform="translate(1,2)" fill="#3300ff"><text> a  b </text></g></g>'
            '<g color="#FFFFFF"><g transform="translate(1,2)" fill="#3300ff" font-size="9"><text>c</text></g>'
            '</g></g>')

    def test_tics_of_an_axis_are_joined(self):
        def tic(y, number):
            return (f"<g w=\"1\"><path stroke='a' class=\"gridline\"  d='M1.00,{y}.00 L9.00,{y}.00'/></g>"
                    f"<g w=\"2\"><path stroke='b'  d='M1.00,{y}.00 L2.00,{y}.00'/><g><text>{number}</text></g></g>")
        self.assertEqual(small_svg(tic(3, "x") + tic(5, "y") + "<g><text>z</text></g>"),
                         "<g w=\"1\"><path stroke='a' class=\"gridline\"  d='M1,3l8,0M1,5l8,0'/></g>"
                         "<g w=\"2\"><path stroke='b'  d='M1,3l1,0M1,5l1,0'/><g><text>x</text></g><g><text>y</text></g></g>"
                         "<g><text>z</text></g>")

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
        self.out = Path(self.scratch.name) / "out"

    def tearDown(self):
        self.scratch.cleanup()

    def tool(self, *arguments):
        return subprocess.run([sys.executable, self.project / "tools" / "make-ledger-page", *map(str, arguments)],
                              capture_output=True, text=True)

    def results(self, figure=True, **change):
        folder = Path(self.scratch.name) / "results"
        shutil.rmtree(folder, ignore_errors=True)
        (folder / "figures").mkdir(parents=True)
        if figure:
            (folder / "figures" / "fig-3.3.svg").write_text("<svg><path d='M1.00,1.00 L2.00,2.00'/></svg>")
        (folder / "claims.json").write_text(json.dumps(ledger(**change)))
        (folder / "claims.md").write_text("# Claims\n")
        return folder

    def made(self):
        return json.loads((self.out / "claims.json").read_text())

    def test_publishes_claims_page_and_figures(self):
        result = self.tool(self.out, self.results())
        self.assertEqual((result.returncode, result.stdout), (0, ""))
        self.assertEqual(self.made()[0]["claims"], [CLAIM])
        self.assertEqual(self.made()[0]["figures"], [FIGURE | {"data": ""}])
        self.assertIn("M1,1l1,1", (self.out / "figures" / "fig-3.3.svg").read_text())
        self.assertEqual((self.project / "docs" / "claims.md").read_text(), "# Claims\n")
        self.assertEqual(self.tool("--check", self.out).returncode, 0)

    def test_figures_of_what_was_not_run_stay(self):
        self.tool(self.out, self.results())
        self.assertEqual(self.tool(self.out, self.results(figure=False, measured="y")).returncode, 0)
        self.assertEqual(self.made()[0]["claims"][0]["measured"], "y")
        self.assertEqual(self.made()[0]["figures"][0]["file"], "figures/fig-3.3.svg")

    def test_a_figure_that_is_not_there_keeps_its_name(self):
        self.tool(self.out, self.results(figure=False))
        self.assertEqual(self.made()[0]["figures"], [{"id": "fig-3.3", "file": "", "data": ""}])

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
        self.assertIn("claims/search.js is not up to date", stale(self.project / "web/laboratory/claims/search.js", "//"))
        self.assertIn("claims/new.js is missing", stale(self.project / "web/laboratory/claims/new.js", "//"))
        self.assertIn("index.html is not up to date", stale(self.out / "index.html", "x"))
        self.assertIn("old.js does not belong there", stale(self.out / "old.js", "x"))
        self.assertIn("figures/fig-9.svg does not belong there", stale(self.out / "figures" / "fig-9.svg", "x"))
        (self.out / "figures" / "fig-3.3.svg").unlink()
        self.assertIn("claims.json is not up to date", self.tool("--check", self.out).stderr)

    def test_every_address_in_the_page_exists_in_the_folder(self):
        self.tool(self.out, self.results())
        page = (self.out / "index.html").read_text()
        for address in re.findall(r'(?:href|src)="([^"#:?]+)"', page):
            self.assertTrue((self.out / address).is_file(), address)
        imports = [(module, address) for module in self.out.rglob("*.js")
                   for address in re.findall(r"^(?:import|export) .*from '([^']+)'|^} from '([^']+)'", module.read_text(), re.M)]
        self.assertGreater(len(imports), 20)
        for module, address in imports:
            self.assertTrue((module.parent / "".join(address)).is_file(), f"{module}: {address}")

    def test_refuses_results_that_are_none(self):
        folder = self.results()
        for text in ('{"scenario": "room"}', '[{"id": "3.1"}]', json.dumps(ledger()).replace('"finding"', '"found"'), "["):
            (folder / "claims.json").write_text(text)
            result = self.tool(self.out, folder)
            self.assertEqual(result.returncode, 2, text)
            self.assertIn("is not what `incognita reproduce` writes", result.stderr)
        self.assertEqual(self.tool(self.out, folder / "absent").returncode, 2)


if __name__ == "__main__":
    unittest.main()
