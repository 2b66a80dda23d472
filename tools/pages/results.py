"""What the texts of docs/numbers.toml are written with: f-strings that may use every function of `Results` and of
tables.py by its name. Paths are those under out/docs, e.g. `summary("first-run")["ate_m"]`; the commands that a page
shows write the same under out/."""

import csv
import json
import re
import statistics
from pathlib import Path


def code(text: str) -> str:
    """As a code block of Markdown."""
    return "\n".join(("    " + line).rstrip() for line in text.rstrip("\n").split("\n"))


def percent(share: float, digits: int = 0) -> str:
    return f"{100 * share:.{digits}f} %"


class Results:
    def __init__(self, output_folder: Path, commands: dict[str, str]):
        self.output_folder, self.commands = output_folder, commands

    def names(self) -> dict:
        """What an f-string of the list may call."""
        own = {name: getattr(self, name) for name in dir(self) if not name.startswith("_") and name != "names"}
        return {"code": code, "percent": percent, "median": statistics.median, "mean": statistics.fmean} | {
            name: value for name, value in own.items() if callable(value)}

    def shell(self, run: str) -> str:
        """The commands of a run, as a reader types them."""
        return code(self.commands[run].replace("out/docs/", "out/"))

    def printed(self, run: str) -> str:
        """What the commands of a run wrote to standard output, as a code block. Speeds are left out: they are another
        on every machine."""
        return code(re.sub(r"^(speed +)\S+", r"\1...", self.output(run), flags=re.MULTILINE))

    def output(self, run: str) -> str:
        return (self.output_folder / f"{run}.stdout").read_text().replace("out/docs/", "out/")

    def document(self, path: str) -> dict:
        return json.loads((self.output_folder / path).read_text())

    def summary(self, folder: str) -> dict:
        """summary.json of a run directory."""
        return self.document(f"{folder}/summary.json")

    def direction(self, folder: str, name: str) -> dict:
        """One quantity of the observability report of a run, e.g. `scale`."""
        return next(d for d in self.summary(folder)["observability"]["directions"] if d["name"] == name)

    def rows(self, path: str) -> list[dict]:
        """A table with a head, as one dictionary per row."""
        with (self.output_folder / path).open() as file:
            return list(csv.DictReader(file))

    def per_seed(self, campaign: str, measure: str, variant: str = "") -> dict[int, float]:
        """A measure of every run of a campaign that was done; `variant` is part of the variant's name."""
        rows = self.rows(f"{campaign}/runs.csv")
        return {int(row["seed"]): float(row[measure]) for row in rows
                if row["status"] == "done" and variant in row["variant"] and row[measure] not in ("", "nan")}

    def failed(self, campaign: str, variant: str = "") -> int:
        return sum(row["status"] != "done" and variant in row["variant"]
                   for row in self.rows(f"{campaign}/runs.csv"))

    def measure(self, campaign: str, measure: str, variant: str = "") -> dict:
        """mean, low, high (95 %), median and n of a measure, as campaign.json has them."""
        variants = [v for v in self.document(f"{campaign}/campaign.json")["variants"] if variant in v["name"]]
        if len(variants) != 1:
            raise KeyError(f"{campaign}: {len(variants)} variants have `{variant}` in their name")
        return variants[0]["measures"][measure]

    def interval(self, campaign: str, measure: str, variant: str = "", scale: float = 1, digits: int = 2) -> str:
        """`2.69 (2.55 - 2.83)`: the mean over seeds and its 95 % interval."""
        m = self.measure(campaign, measure, variant)
        mean, low, high = (f"{scale * m[key]:.{digits}f}" for key in ("mean", "low", "high"))
        return f"{mean} ({low} - {high})"

    def machine(self, run: str) -> str:
        """The processor that a run was made on."""
        return (self.output_folder / f"{run}.machine").read_text()

    def bench(self, run: str, name: str, part: int = 0) -> dict:
        """Counters of one benchmark of a program run with --benchmark_format=json; `part`: of several programs."""
        decoder, text, documents = json.JSONDecoder(), self.output(run), []
        while text.strip():
            document, end = decoder.raw_decode(text.lstrip())
            documents.append(document)
            text = text.lstrip()[end:]
        return next(b for b in documents[part]["benchmarks"] if b["name"] == name or b["name"].startswith(f"{name}/"))
