"""What tools/describe-comparison and the tables of the pages both take from a comparison of strategies."""

import math
import random
import statistics
from dataclasses import dataclass

MAPPED, UNTIL, MAP_ERROR, PATH_ERROR = "exploration.mapped_60_s", "exploration.t_90_mapped_s", "map_error_m", "ate_m"
RATIO_OF_ERRORS = 1.25  # up to that an error is no larger
SCENARIOS_WITH_PLAN = ("map-room", "map-terrain")


def strategy_and_rate(variant: str) -> tuple[str, str]:
    """`lawn-mower` and `0.4`, rad/s, of `decision.strategy=lawn-mower decision.gaze_rate_rad_s=0.4`. The rate is "" where the variant
    does not set it; a scenario as it is has the plan; a variant that sets no strategy is named by its settings."""
    settings = dict(word.partition("=")[::2] for word in variant.split())
    if "decision.strategy" in settings:
        return settings["decision.strategy"], settings.get("decision.gaze_rate_rad_s", "")
    return "plan" if variant in SCENARIOS_WITH_PLAN else variant, ""


def until_mapped(rows: list[dict]) -> dict[str, tuple[float, int, int]]:
    """Of runs.csv, by variant: the median time until 90 % of the surface was mapped, where a run that did not get there or failed
    counts as longer than all others; the number of runs that did; and that of all runs."""
    times: dict[str, list[float]] = {}
    for row in rows:
        value = float(row[UNTIL] or "nan") if row["status"] == "done" else math.nan
        times.setdefault(row["variant"], []).append(math.inf if math.isnan(value) else value)
    return {variant: (statistics.median(of), sum(map(math.isfinite, of)), len(of)) for variant, of in times.items()}


@dataclass(frozen=True)
class Judged:
    goal: str
    against: str   # the variant that is best in what is judged; "" where there is no other
    measured: str
    met: str       # yes, no, or undecided


def values_of(rows: list[dict], measure: str) -> dict[str, dict[str, float]]:
    """Of runs.csv, by variant and seed: a measure of the runs that are done and have it."""
    found: dict[str, dict[str, float]] = {}
    for row in rows:
        value = float(row[measure] or "nan") if row["status"] == "done" else math.nan
        if not math.isnan(value):
            found.setdefault(row["variant"], {})[row["seed"]] = value
    return found


def ratio_of_medians(ours: dict[str, float], theirs: dict[str, float], draws: int = 2000) -> tuple[float, float, float]:
    """With its 95 % interval: rooms are drawn with replacement, of both strategies the same ones."""
    rooms = sorted(ours.keys() & theirs.keys())
    drawn = random.Random(1)

    def ratio(of: list[str]) -> float:
        return statistics.median(ours[room] for room in of) / statistics.median(theirs[room] for room in of)

    ratios = sorted(ratio(drawn.choices(rooms, k=len(rooms))) for _ in range(draws))
    return ratio(rooms), ratios[draws // 40], ratios[-1 - draws // 40]


def judge_share(rows: list[dict], ours: str, differences: dict[str, dict]) -> Judged:
    """`differences`: of each other variant the mean difference of the share mapped, it minus ours, with its interval."""
    mapped = values_of(rows, MAPPED)
    most = max((v for v in mapped if v != ours), key=lambda v: statistics.fmean(mapped[v].values()))
    more, low, high = (-100 * differences[most][key] for key in ("difference", "high", "low"))
    return Judged("map more of the surface in 60 s", most, f"{more:+.1f} % ({low:+.1f} to {high:+.1f})",
                  "yes" if low > 0 else "no" if high <= 0 else "undecided")


def judge_time(rows: list[dict], ours: str) -> Judged:
    """A run that does not get there counts as longer than all others, so that a median of 60 s or more is unknown."""
    until = until_mapped(rows)
    (time_s, reached, runs), soonest = until.pop(ours), min(until, key=lambda v: (until[v][0], -until[v][1]))
    other_s, others_reached, other_runs = until[soonest]

    def said(seconds: float) -> str:
        return f"{seconds:.0f} s" if math.isfinite(seconds) else "not in 60 s"

    measured = f"{said(time_s)}, in {reached} of {runs} rooms; against {said(other_s)}, in {others_reached} of {other_runs}"
    half = time_s <= (other_s if math.isfinite(other_s) else 60) / 2
    met = "yes" if half else "undecided" if math.isinf(other_s) and math.isfinite(time_s) else "no"
    return Judged("map 90 % in at most half the time (medians)", soonest, measured, met)


def judge_error(rows: list[dict], ours: str, measure: str, goal: str) -> Judged:
    """Against the strategy whose median is least. An interval on both sides of the limit leaves it undecided."""
    errors = values_of(rows, measure)
    best = min((v for v in errors if v != ours), key=lambda v: statistics.median(errors[v].values()))
    ratio, low, high = ratio_of_medians(errors[ours], errors[best])
    met = "yes" if high < RATIO_OF_ERRORS else "no" if low >= RATIO_OF_ERRORS else "undecided"
    return Judged(goal, best, f"ratio {ratio:.2f} ({low:.2f} to {high:.2f})", met)


def judge_safety(rows: list[dict], ours: str, allowed: int) -> Judged:
    ended = [row for row in rows if row["variant"] == ours]
    lost = sum(row["status"] != "done" or float(row["exploration.diverged"] or 0) > 0 for row in ended)
    share = allowed / 100 * len(ended)
    return Judged(f"be lost or diverge in at most {allowed} of 100 rooms", "", f"{lost} of {len(ended)}",
                  "yes" if lost <= share else "no")


def judge(rows: list[dict], ours: str, differences: dict[str, dict], allowed_lost: int) -> list[Judged]:
    """A part of tools/compare-strategies by the rules that it states."""
    return [judge_share(rows, ours, differences), judge_time(rows, ours), judge_error(rows, ours, MAP_ERROR, "have no larger map error"),
            judge_error(rows, ours, PATH_ERROR, "have no larger path error"), judge_safety(rows, ours, allowed_lost)]
