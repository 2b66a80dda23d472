"""tools/describe-comparison and the rows of the comparison in the pages say what a campaign shows, also where values are missing."""

import json
import subprocess
import sys
import tempfile
import unittest
from math import nan
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))
from pages import comparison, tables  # noqa: E402
from pages.results import Results  # noqa: E402

MEASURES = {"exploration.mapped_60_s": (0.9, 0.85), "exploration.t_90_mapped_s": (50, 55), "map_error_m": (0.02, 0.03),
            "ate_m": (0.01, 0.02), "exploration.diverged": (0, 0)}


def measures(which: int, difference: dict | None) -> dict:
    """Of the plan (0), of the sweep (1), or of a strategy whose runs all failed (2)."""
    found = {}
    for name, values in MEASURES.items():
        value = values[which] if which < 2 else None
        found[name] = {"n": 5 if which < 2 else 0, "ended": 5, "mean": value, "low": value, "high": value, "median": value}
        if difference:
            found[name]["versus_baseline"] = difference
    return found


def variant(name: str, which: int, difference: dict | None) -> dict:
    varied = {"decision.strategy": json.dumps(name)} if which else {}
    return {"name": f"decision.strategy={name}" if which else name, "varied": varied, "runs": 5, "done": 0 if which == 2 else 5,
            "failed": 5 if which == 2 else 0, "measures": measures(which, difference)}


class Comparison(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.folder = Path(self.scratch.name)
        self.write({"difference": -0.05, "low": -0.06, "high": -0.04})

    def tearDown(self):
        self.scratch.cleanup()

    def write(self, sweep_minus_plan: dict):
        nothing = {"difference": None, "low": None, "high": None}
        variants = [variant("map-room", 0, None), variant("lawn-mower", 1, sweep_minus_plan), variant("none", 2, nothing)]
        self.put("campaign.json", json.dumps({"seeds": [1, 2, 3, 4, 5], "baseline": "map-room", "variants": variants}))
        runs, timings = "variant,seed,status,exploration.t_90_mapped_s\n", "variant,seed,timing_ms.decision.p99,timing_ms.frame.p99\n"
        for v in variants:
            for seed in range(1, 6):
                reached = 40 + seed if seed < 4 or v["name"] == "map-room" else "nan"
                runs += f"{v['name']},{seed},{'failed' if v['failed'] else 'done'},{reached}\n"
                timings += f"{v['name']},{seed},{'nan,nan' if v['failed'] else '5,20'}\n"
        self.put("runs.csv", runs)
        self.put("timings.csv", timings)

    def put(self, name: str, text: str):
        (self.folder / name).write_text(text)

    def said(self) -> tuple[int, str]:
        ended = subprocess.run([sys.executable, ROOT / "tools" / "describe-comparison", self.folder], text=True,
                               capture_output=True)
        return ended.returncode, ended.stdout + ended.stderr

    def test_says_what_maps_more_and_what_it_costs(self):
        code, said = self.said()
        self.assertEqual(code, 0, said)
        for words in ("In 5 rooms", "the plan: 90 % of the surface", "90 % mapped in 5 of 5 rooms, after 43 s",
                      "a sweep in lanes: 85 %", "90 % mapped in 3 of 5 rooms, after 43 s", "it maps more (mean difference +5.0 %",
                      "the plan: 5.0 ms for the decision, 20 ms in all"):
            self.assertIn(words, said)

    def test_a_time_that_most_runs_do_not_reach_has_no_median(self):
        runs = (self.folder / "runs.csv").read_text().replace("lawn-mower,3,done,43", "lawn-mower,3,done,nan")
        self.put("runs.csv", runs)
        self.assertIn("90 % mapped in 2 of 5 rooms\n", self.said()[1])

    def test_failed_runs_have_no_values(self):
        said = self.said()[1]
        self.assertIn("standing still: share of the surface mapped after 60 s unknown", said)
        self.assertIn("90 % mapped in 0 of 5 rooms; failed in 5", said)
        self.assertNotIn("standing still: nan", said)

    def test_says_less_undecided_and_too_few(self):
        for interval, words in (((0.02, 0.03), "it maps less"), ((-0.02, 0.03), "undecided whether"),
                                ((None, None), "too few rooms")):
            self.write({"difference": 0.01, "low": interval[0], "high": interval[1]})
            self.assertIn(words, self.said()[1])

    def test_refuses_what_it_cannot_describe(self):
        document = json.loads((self.folder / "campaign.json").read_text())
        self.put("campaign.json", json.dumps(document | {"baseline": "decision.strategy=none"}))
        code, said = self.said()
        self.assertEqual(code, 1)
        self.assertIn("not its first variant", said)
        self.put("runs.csv", "variant,seed,status\nmap-room,1,done\n")
        self.put("campaign.json", json.dumps(document))
        self.assertIn("no 'exploration.t_90_mapped_s'", self.said()[1])
        (self.folder / "campaign.json").unlink()
        self.assertEqual(self.said()[0], 1)

    def two_rates(self):
        """The strategy of the thesis at two rates: the slower one maps more, the faster one is sooner."""
        self.slow, self.fast = (f"decision.strategy=mutual-information decision.max_elevation_rad=0.8 decision.gaze_rate_rad_s={rate}"
                                for rate in ("0.6", "0.8"))
        document = json.loads((self.folder / "campaign.json").read_text())
        plan, sweep, standing = document["variants"]
        rivals = [json.loads(json.dumps(sweep)) | {"name": name} for name in (self.slow, self.fast)]
        rivals[0]["measures"]["exploration.mapped_60_s"]["median"] = 0.88
        self.put("campaign.json", json.dumps(document | {"variants": [plan, *rivals]}))
        columns = ("exploration.mapped_60_s", "exploration.t_90_mapped_s", "map_error_m", "ate_m", "exploration.diverged")
        runs = f"variant,seed,status,{','.join(columns)}\n"
        for name, values in (("map-room", "0.9,20,0.02,0.01,0"), (self.slow, "0.88,40,0.03,0.01,0"), (self.fast, "0.85,25,0.04,0.02,0")):
            runs += "".join(f"{name},{seed},done,{values}\n" for seed in range(1, 6))
        self.put("runs.csv", runs)
        self.put("timings.csv", "variant,seed,timing_ms.decision.p99,timing_ms.frame.p99\n"
                 + "".join(f"{name},1,{ms},20\n" for name, ms in (("map-room", 5), (self.slow, 6), (self.fast, 7))))

    def test_a_strategy_at_two_rates_is_two_strategies(self):
        self.two_rates()
        results = Results(self.folder.parent, {})
        for rows in (tables.compared_rows(results, self.folder.name), tables.compared_summary(results, self.folder.name)):
            self.assertEqual([row.split(" | ")[0] for row in rows.split("\n")],
                             ["| `plan`", "| `mutual-information`, 0.6 rad/s", "| `mutual-information`, 0.8 rad/s"])
        judged = [row.split(" | ")[1] for row in tables.judged_rows(results, self.folder.name, 1).split("\n")]
        slow, fast = "`mutual-information`, 0.6 rad/s", "`mutual-information`, 0.8 rad/s"
        self.assertEqual(judged, [slow, fast, slow, slow, "-"])
        said = self.said()[1]
        for words in ("(thesis) at 0.6 rad/s: 88 %", "(thesis) at 0.6 rad/s: 6.0 ms", "(thesis) at 0.8 rad/s: 7.0 ms",
                      "against the one that maps most, the next action by mutual information (thesis) at 0.6 rad/s:"):
            self.assertIn(words, said)

    def test_rows_of_the_summary(self):
        rows = tables.compared_summary(Results(self.folder.parent, {}), self.folder.name).split("\n")
        self.assertEqual(rows, ["| `plan` | 90.0 | 43 | 2.0 | 1.0 | 0 |", "| `lawn-mower` | 85.0 | 43 | 3.0 | 2.0 | 0 |",
                                "| `none` | - | > 60 | - | - | 5 |"])

    def test_the_baseline_has_the_first_row(self):
        document = json.loads((self.folder / "campaign.json").read_text())
        self.put("campaign.json", json.dumps(document | {"variants": document["variants"][::-1]}))
        rows = tables.compared_summary(Results(self.folder.parent, {}), self.folder.name).split("\n")
        self.assertIn("`plan`", rows[0])

    def test_names_of_variants(self):
        for name, code in (("map-terrain", "`plan`"), ("decision.strategy=none decision.gaze_rate_rad_s=0.4", "`none`, 0.4 rad/s"),
                           ("decision.strategy=frontier", "`frontier`"), ("decision.gaze_rate_rad_s=0.4", "`decision.gaze_rate_rad_s=0.4`"),
                           ("", "-")):
            self.assertEqual(tables.code_name(name), code)

    def test_rows_of_the_page(self):
        rows = tables.compared_rows(Results(self.folder.parent, {}), self.folder.name).split("\n")
        self.assertEqual(rows[0], "| `plan` | 90.0 | - | 43 | 5 of 5 | 2.0 | - | 1.0 | - | 0 |")
        self.assertIn("| `lawn-mower` | 85.0 | -5.0 (-6.0 to -4.0) | 43 | 3 of 5 | 3.0 |", rows[1])
        self.assertEqual(rows[2], "| `none` | - | - | > 60 | 0 of 5 | - | - | - | - | 5 |")


def runs(variant: str, share: float, until: list[float], map_error: float, diverged: int = 0) -> list[dict]:
    """Rows of runs.csv: one run per time in `until`, of which the first `diverged` diverged."""
    return [{"variant": variant, "seed": str(seed), "status": "done", "exploration.mapped_60_s": str(share),
             "exploration.t_90_mapped_s": str(time), "map_error_m": str(map_error * (1 + 0.01 * seed)), "ate_m": "0.01",
             "exploration.diverged": str(int(seed < diverged))} for seed, time in enumerate(until)]


class Judged(unittest.TestCase):
    """The rules of tools/compare-strategies."""

    def judged(self, ours: list[dict], *others: list[dict], low: float = -0.06, high: float = -0.04) -> dict:
        difference = {"difference": (low + high) / 2, "low": low, "high": high}
        rows = [*ours, *(row for other in others for row in other)]
        differences = {row["variant"]: difference for other in others for row in other}
        return dict(zip(("share", "time", "map", "path", "lost"), comparison.judge(rows, "plan", differences, 2)))

    def test_meets_all(self):
        found = self.judged(runs("plan", 0.9, [25] * 9, 0.02), runs("sweep", 0.8, [50] * 9, 0.02), runs("none", 0.3, [nan] * 9, 0.1))
        self.assertEqual([j.met for j in found.values()], ["yes"] * 5)
        self.assertEqual(found["share"].against, "sweep")
        self.assertEqual(found["share"].measured, "+5.0 % (+4.0 to +6.0)")
        self.assertEqual(found["time"].measured, "25 s, in 9 of 9 rooms; against 50 s, in 9 of 9")

    def test_meets_none(self):
        found = self.judged(runs("plan", 0.7, [40] * 9, 0.04, diverged=1), runs("sweep", 0.8, [50] * 9, 0.02), low=0.01, high=0.02)
        self.assertEqual({goal: j.met for goal, j in found.items()}, {"share": "no", "time": "no", "map": "no", "path": "yes", "lost": "no"})
        self.assertEqual(found["map"].measured, "ratio 2.00 (2.00 to 2.00)")

    def test_an_interval_on_both_sides_is_undecided(self):
        self.assertEqual(self.judged(runs("plan", 0.9, [25], 0.02), runs("sweep", 0.8, [50], 0.02), low=-0.1, high=0.1)["share"].met,
                         "undecided")
        errors = runs("plan", 0.9, [25] * 8, 0.02)
        for row in errors[:4]:
            row["map_error_m"] = "0.04"
        self.assertEqual(self.judged(errors, runs("sweep", 0.8, [50] * 8, 0.02))["map"].met, "undecided")

    def test_a_time_that_the_others_do_not_reach(self):
        for until, met in ((29, "yes"), (40, "undecided"), (nan, "no")):
            self.assertEqual(self.judged(runs("plan", 0.9, [until] * 3, 0.02), runs("sweep", 0.8, [nan] * 3, 0.02))["time"].met, met)

    def test_a_failed_run_is_lost_and_its_room_has_no_error(self):
        ours = runs("plan", 0.9, [25] * 9, 0.02)
        ours[0] = {**dict.fromkeys(ours[0], ""), "variant": "plan", "seed": "0", "status": "failed"}
        found = self.judged(ours, runs("sweep", 0.8, [50] * 9, 0.02))
        self.assertEqual((found["lost"].measured, found["lost"].met), ("1 of 9", "no"))
        self.assertEqual(found["map"].met, "yes")


if __name__ == "__main__":
    unittest.main()
