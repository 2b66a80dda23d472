"""Rows and numbers of single pages, made of results. Every function with a docstring may be used in docs/numbers.toml."""

import json
import math
import re
import statistics
import tomllib
from functools import partial

from pages.comparison import MAP_ERROR, MAPPED, PATH_ERROR, judge, strategy_and_rate, until_mapped
from pages.results import Results, percent


def claim(results: Results, run: str, id: str) -> str:
    """What `reproduce` measured for a claim, without the name in front and what is compared behind."""
    claims = (c for entry in results.document(f"{run}/claims.json") for c in entry["claims"])
    measured = next(c for c in claims if c["id"] == id)["measured"]
    return measured.split(": ", 1)[-1].split(";")[0]


def verdict_row(results: Results, folder: str) -> str:
    """A scenario's NEES, NIS and verdicts: of the runs of a campaign that are done, or of one run."""
    paths = sorted((results.output_folder / folder).glob("runs/*/seed-*.json"))
    summaries = [json.loads(path.read_text())["summary"] for path in paths] or [results.summary(folder)]
    done = [s["consistency"] for s in summaries if s["status"] == "done"]

    def spread(measure: str) -> str:
        values = [c[measure] for c in done if c[measure] is not None]
        low, high = f"{min(values):.2f}", f"{max(values):.2f}"
        return low if low == high else f"{low} to {high}"

    verdicts = [c["verdict"] for c in done]
    name = folder.split("/")[-1].removesuffix("-40")
    return (f"| `{name}` | {len(done)} | {spread('nees')} | {spread('nis')} | {verdicts.count('overconfident')} | "
            f"{verdicts.count('conservative')} |")


def noise_cells(results: Results, campaign: str) -> str:
    """Cells of a camera in the rendered room, over the seeds of a campaign: NEES, NIS, position error, frames beyond 3 sigma, outliers,
    and frames in which it was lost, those of runs that failed too."""
    def middle(measure: str, scale: float = 1) -> str:
        return f"{scale * statistics.median(results.per_seed(campaign, measure).values()):.2f}"

    def total(measure: str) -> float:
        return sum(results.per_seed(campaign, measure).values())

    beyond = total("overconfident_frames") / total("frames")
    outliers = statistics.fmean(results.per_seed(campaign, "consistency.outlier_share").values())
    lost = sum(int(row["lost_frames"]) for row in results.rows(f"{campaign}/runs.csv") if row["lost_frames"] not in ("", "nan"))
    return (f"{middle('mean_nees')} ({range_of(results, campaign, 'mean_nees')}) | {middle('mean_nis')} | {middle('ate_m', 1000)} | "
            f"{percent(beyond, 2)} | {percent(outliers, 1)} | {lost} |")


def first(results: Results, seeds: int, values: dict[int, float]) -> list[float]:
    """The values of seeds 1 to `seeds`."""
    return [value for seed, value in values.items() if seed <= seeds]


def range_of(results: Results, campaign: str, measure: str, scale: float = 1, digits: int = 2) -> str:
    """`2.71 to 3.58`: least and largest over the seeds."""
    values = results.per_seed(campaign, measure).values()
    return f"{scale * min(values):.{digits}f} to {scale * max(values):.{digits}f}"


def rms_px(results: Results, path: str) -> float:
    """Of a table by build/patch_error: the error of a match."""
    return math.sqrt(float(results.rows(path)[0]["covariance_px2"]))


def fast_px(results: Results, path: str) -> float:
    """Of such a table: the part of the error that is not there in the next frame any more."""
    now, next_frame = (float(row["covariance_px2"]) for row in results.rows(path)[:2])
    return math.sqrt(now - next_frame)


def car_row(results: Results, folder: str) -> str:
    """A filter's rank and what it has gained of its heading."""
    report, heading = results.summary(folder)["observability"], results.direction(folder, "heading")
    scenario = tomllib.loads((results.output_folder / folder / "effective.toml").read_text())
    start = math.degrees(scenario["start"]["sigma_heading_rad"])
    gained = math.degrees(heading["estimated_sigma"]) if heading["gained"] else math.inf
    last = list(results.rows(f"{folder}/covariance.csv")[-1].values())
    filter_sigma = math.degrees(math.sqrt(float(last[36])))  # after t, the 6x6 covariance row by row
    told = f"{gained:.2f}" if heading["gained"] else "nothing"
    both = 1 / math.sqrt(1 / gained**2 + 1 / start**2)
    return (f"| `{folder.split('/')[-1]}` | {report['rank']}, {report['ideal_rank']}, {report['errors']} | {told} | "
            f"{both:.2f} | {filter_sigma:.2f} |")


def camera_row(results: Results, folder: str, settings: str) -> str:
    """Ranks of a camera without a target, and what it wrongly takes for known."""
    report = results.summary(folder)["observability"]
    turn, scale = results.direction(folder, "rotation about z"), results.direction(folder, "scale")
    measured = turn["sigma_from_measurements"]
    return (f"| {settings} | {report['rank']} | {report['ideal_rank']} | {report['errors']} | "
            f"{report['spurious_information']} | {report['by_motion_model']} | "
            f"{'-' if measured is None else f'{math.degrees(measured):.2f}'} | "
            f"{percent(scale['sigma_from_measurements'], 1)}, {percent(scale['estimated_sigma'], 1)} |")


NUMBER = r"(-?[\d.]+(?:e[+-]\d+)?)"
DIFFERENCE = re.compile(rf"{NUMBER} nats \({NUMBER} to {NUMBER}\)")
OF_RUNS = re.compile(rf"entropy {NUMBER} nats, position error {NUMBER} m, (\d+) diverged, {NUMBER} % seen, {NUMBER} located")


def plain(number: str) -> str:
    """`-1.47e+03` as -1470."""
    return f"{float(number):.4g}" if "e" in number else number


def named_parts(text: str) -> dict[str, str]:
    """`a: 1; b: 2` by name."""
    return dict(part.split(": ", 1) for part in text.split("; "))


def compared(results: Results, claim_id: str) -> tuple[dict, dict[str, str], dict[str, str]]:
    """A claim of docs/ledger/claims.json that a strategy leaves less entropy than others: the claim; its differences of
    entropy by rival; and what became of each strategy, by name."""
    claim = next((claim for entry in json.loads(results.output("ledger")) for claim in entry["claims"]
                  if claim["id"] == claim_id), None)
    if claim is None:
        raise KeyError(f"docs/ledger/claims.json: no claim `{claim_id}`")
    differences, became = claim["measured"].split(". ", 1)
    return claim, named_parts(differences.removeprefix("entropy less that of ")), named_parts(became)


def gain_of(results: Results, claim_id: str, ours: str, rival: str) -> tuple[list[str], list[str], list[str]]:
    """Difference of entropy with its interval; and of both strategies position error, diverged, room seen."""
    _, differences, became = compared(results, claim_id)
    try:
        difference = DIFFERENCE.fullmatch(differences[rival])
        runs = [OF_RUNS.fullmatch(became[name]) for name in (ours, rival)]
    except KeyError as name:
        raise KeyError(f"docs/ledger/claims.json, {claim_id}: no strategy {name}") from None
    if not (difference and all(runs)):
        raise KeyError(f"docs/ledger/claims.json, {claim_id}: the measured text is not that of a comparison")
    return [plain(number) for number in difference.groups()], list(runs[0].groups()), list(runs[1].groups())


def gain_row(results: Results, claim_id: str, ours: str, rival: str) -> str:
    """What moving by information gained over another strategy, and what it cost: cells."""
    (gap, low, high), (_, error, diverged, seen, _), (_, other_error, other_diverged, other_seen, _) = gain_of(
        results, claim_id, ours, rival)
    answer = "yes" if float(high) < 0 else "no" if float(low) >= 0 else "undecided"
    return (f"{gap} ({low} to {high}) | {answer} | {error} / {other_error} | {seen} / {other_seen} | "
            f"{diverged} / {other_diverged} |")


def gain_sentence(results: Results, claim_id: str, ours: str, rival: str) -> str:
    """The same in words."""
    (gap, low, high), (_, error, _, seen, _), (_, other_error, _, other_seen, _) = gain_of(results, claim_id, ours, rival)
    if float(high) >= 0:
        raise KeyError(f"docs/ledger/claims.json, {claim_id}: not less entropy than {rival}; the sentence says it is")
    return (f"With the twelve features of the thesis, over {compared(results, claim_id)[0]['runs']} rooms, mutual information leaves "
            f"{gap.lstrip('-')} nats less entropy than random motion (95 % interval {high.lstrip('-')} to {low.lstrip('-')}), "
            f"but its median position error is {error} m against {other_error} m, and the camera sees {seen} % of the room "
            f"against {other_seen} %.")


def right_matches(results: Results, campaign: str, variant: str = "") -> float:
    """Share of all matches of a campaign's runs that were right."""
    right, wrong = (sum(results.per_seed(campaign, f"matches_{word}", variant).values()) for word in ("right", "wrong"))
    return right / (right + wrong)


def names_row(results: Results, campaign: str) -> str:
    """Cells of errors without identities, those with them in brackets."""
    def middle(measure: str, variant: str) -> float:
        return statistics.median(results.per_seed(campaign, measure, variant).values())

    largest = max(results.per_seed(campaign, "ate_m", "nearest").values())
    return (f"{middle('ate_m', 'nearest'):.3f} ({middle('ate_m', 'known'):.3f}), {largest:.2f} | "
            f"{middle('mean_nees', 'nearest'):.2f} ({middle('mean_nees', 'known'):.2f})")


def bench_row(results: Results, run: str, name: str, cells: str) -> str:
    """A row of a table: `counter:format` is a counter of the benchmark, any other word stands as it is."""
    counters = results.bench(run, name)
    cells = (f"{counters[word.partition(':')[0]]:{word.partition(':')[2]}}" if ":" in word else word.replace("_", " ")
             for word in cells.split())
    return f"| {' | '.join(cells)} |"


def path_rows(results: Results, run: str) -> str:
    """Of build/belief_bench: each instruction set's rank update against Eigen's."""
    rows = []
    for path, name in (("avx512", "avx512"), ("avx2", "avx2"), ("baseline", "baseline (SSE2)")):
        try:
            sizes = {size: results.bench(run, f"rank_update/{path}/{size}") for size in (300, 600, 1200, 3000)}
        except StopIteration:
            continue  # this processor does not have it
        ratios = " | ".join(f"{counters['ratio']:.2f}" for counters in sizes.values())
        rows.append(f"| {name} | {ratios} | {sizes[1200]['GB/s']:.1f} | {sizes[1200]['pass_GB/s']:.1f} |")
    return "\n".join(rows)


def number(results: Results, value: float | None, scale: float = 1, digits: int = 1) -> str:
    """A measure of campaign.json; `-` without a value."""
    return "-" if value is None else f"{scale * value:.{digits}f}"


def minus_the_baseline(results: Results, variant: dict, measure: str, scale: float = 1) -> str:
    """Mean difference with its interval."""
    pairs = variant["measures"][measure].get("versus_baseline")
    if not pairs or pairs["low"] is None:
        return "-"
    difference, low, high = (f"{scale * pairs[key]:+.1f}" for key in ("difference", "low", "high"))
    return f"{difference} ({low} to {high})"


def cells_of(results: Results, variant: dict, until: tuple[float, int, int]) -> dict[str, str]:
    """The cells of a variant in the tables of a comparison, by column: errors in cm, shares in percent, differences from the baseline."""
    median_s, reached, runs = until
    of = variant["measures"]
    diverged = round((of["exploration.diverged"]["mean"] or 0) * of["exploration.diverged"]["n"]) + variant["failed"]
    cells = {"strategy": code_name(variant["name"]), "mapped": number(results, of[MAPPED]["mean"], 100),
             "mapped, difference": minus_the_baseline(results, variant, MAPPED, 100),
             "until 90 %": "> 60" if math.isinf(median_s) else f"{median_s:.0f}", "rooms": f"{reached} of {runs}"}
    for error in (MAP_ERROR, PATH_ERROR):
        cells[error] = number(results, of[error]["median"], 100)
        cells[f"{error}, difference"] = minus_the_baseline(results, variant, error, 100)
    return cells | {"diverged": str(diverged)}


def rows_of_cells(results: Results, campaign: str, columns: tuple[str, ...] | None = None) -> str:
    """Rows of a table of a campaign of tools/compare-strategies, one per variant, the baseline first; all columns unless some are
    named."""
    document, until = results.document(f"{campaign}/campaign.json"), until_mapped(results.rows(f"{campaign}/runs.csv"))
    variants = sorted(document["variants"], key=lambda variant: variant["name"] != document["baseline"])
    rows = (cells_of(results, variant, until[variant["name"]]) for variant in variants)
    return "\n".join(f"| {' | '.join(row[column] for column in columns or row)} |" for row in rows)


def compared_rows(results: Results, campaign: str) -> str:
    """Of each variant: share mapped after 60 s, and minus that of the baseline; median time until 90 %, and in how many rooms; errors of
    map and path, medians, and minus those of the baseline; diverged or failed."""
    return rows_of_cells(results, campaign)


def compared_summary(results: Results, campaign: str) -> str:
    """The same without the differences and the number of rooms."""
    return rows_of_cells(results, campaign, ("strategy", "mapped", "until 90 %", MAP_ERROR, PATH_ERROR, "diverged"))


def judged_rows(results: Results, campaign: str, allowed_lost: int) -> str:
    """Such a campaign by the rules of tools/compare-strategies: goal, best other strategy, measured, met."""
    document = results.document(f"{campaign}/campaign.json")
    differences = {v["name"]: v["measures"][MAPPED]["versus_baseline"] for v in document["variants"]
                   if v["name"] != document["baseline"]}
    judged = judge(results.rows(f"{campaign}/runs.csv"), document["baseline"], differences, allowed_lost)
    return "\n".join(f"| {j.goal} | {code_name(j.against)} | {j.measured} | {j.met} |" for j in judged)


def code_name(variant: str) -> str:
    """`lawn-mower`, 0.4 rad/s, of `decision.strategy=lawn-mower decision.max_elevation_rad=0.8 decision.gaze_rate_rad_s=0.4`."""
    strategy, rate = strategy_and_rate(variant)
    return "-" if not strategy else f"`{strategy}`, {rate} rad/s" if rate else f"`{strategy}`"


def stages(results: Results, folder: str, *names: str) -> str:
    """Medians of stages of a run, as cells."""
    times = results.summary(folder)["timing_ms"]
    return " | ".join(f"{times[name]['median']:.2f}" for name in names)


def stage_row(results: Results, folder: str, name: str) -> str:
    """Median and 99th percentile of a stage of a run."""
    times = results.summary(folder)["timing_ms"][name]
    return f"| `{name}` | {times['median']:.2f} | {times['p99']:.2f} |"


def megabytes(results: Results, path: str) -> float:
    """Size of a file."""
    return (results.output_folder / path).stat().st_size / 1e6


def setting_tables(results: Results, path: str) -> str:
    """Every setting of `incognita config --all --json`, a table per section."""
    sections: dict[str, list[str]] = {}
    for s in results.document(path)["settings"]:
        section, name = s["key"].split(".", 1)
        value = json.dumps(s["default"], ensure_ascii=False)
        allowed = s["allowed"].replace("|", "\\|")
        needs = f"`{s['with']}`" if s["with"] else ""
        sections.setdefault(section, []).append(f"| `{name}` | `{value}` | {allowed} | {s['help']} | {needs} |")
    head = "| setting | default | values | meaning | with, e.g. |\n|---|---|---|---|---|\n"
    return "\n\n".join(f"### `[{section}]`\n\n{head}" + "\n".join(rows) for section, rows in sections.items())


def renamed_rows(results: Results, path: str) -> str:
    """The settings that were renamed: before, after."""
    return "\n".join(f"| `{r['before']}` | `{r['after']}` |" for r in results.document(path)["renamed"])


def functions(results: Results) -> dict:
    """All of the above by name, for these results."""
    own = {name: value for name, value in globals().items()
           if callable(value) and getattr(value, "__module__", "") == __name__ and name != "functions"}
    return {name: partial(value, results) for name, value in own.items()}
