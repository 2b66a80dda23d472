"""What tools/describe-comparison and the tables of the pages both take from a comparison of strategies."""

import math
import statistics

UNTIL = "exploration.t_90_mapped_s"


def until_mapped(rows: list[dict]) -> dict[str, tuple[float, int, int]]:
    """Of runs.csv, by variant: the median time until 90 % of the surface was mapped, where a run that did not get there or failed
    counts as longer than all others; the number of runs that did; and that of all runs."""
    times: dict[str, list[float]] = {}
    for row in rows:
        value = float(row[UNTIL] or "nan") if row["status"] == "done" else math.nan
        times.setdefault(row["variant"], []).append(math.inf if math.isnan(value) else value)
    return {variant: (statistics.median(of), sum(map(math.isfinite, of)), len(of)) for variant, of in times.items()}
