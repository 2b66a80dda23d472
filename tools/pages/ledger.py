"""docs/claims.md as data: strictly what `incognita reproduce` writes, nothing is guessed."""

import re
from dataclasses import dataclass, field

VERDICTS = ("holds", "holds-as-corrected", "does-not-hold", "undecided")
COLUMNS = ("place", "statement", "printed", "measured", "verdict", "why")
HEAD = "| " + " | ".join(COLUMNS) + " |\n" + "|---" * len(COLUMNS) + "|\n"


class LedgerError(Exception):
    """The page is not as `incognita reproduce` writes it."""


@dataclass
class Entry:
    id: str
    title: str
    skipped: str = ""
    claims: list[dict[str, str]] = field(default_factory=list)
    figures: list[str] = field(default_factory=list)  # `figures/fig-3.4.svg`


def plain(text: str) -> str:
    """Escaped for Markdown, as incognita/report/ledger.cpp does it."""
    return re.sub(r"([|*`<])", r"\\\1", text)


def unescaped(text: str) -> str:
    return re.sub(r"\\([|*`<])", r"\1", text)


def claim_of(line: str, where: str) -> dict[str, str]:
    cells = re.split(r"(?<!\\)\|", line)
    if len(cells) != len(COLUMNS) + 2:
        raise LedgerError(f"{where}: {len(cells) - 2} columns, not {len(COLUMNS)}")
    claim = {name: unescaped(cell[1:-1]) for name, cell in zip(COLUMNS, cells[1:-1])}
    claim["verdict"] = claim["verdict"].replace(" ", "-")
    if claim["verdict"] not in VERDICTS:
        raise LedgerError(f"{where}: `{claim['verdict']}` is no verdict")
    return claim


def markdown(entries: list[Entry]) -> str:
    """The entries as the page has them, without its introduction."""
    text = "| verdict | claims |\n|---|---|\n"
    for verdict in VERDICTS:
        count = sum(claim["verdict"] == verdict for entry in entries for claim in entry.claims)
        text += f"| {verdict.replace('-', ' ')} | {count} |\n"
    if skipped := sum(entry.skipped != "" for entry in entries):
        text += f"| (entries skipped) | {skipped} |\n"
    for entry in entries:
        text += f"\n## {plain(entry.id)}: {plain(entry.title)}\n"
        text += f"\nSkipped: {plain(entry.skipped)}\n" if entry.skipped else ""
        text += "\n" + HEAD if entry.claims else ""
        for claim in entry.claims:
            cells = claim | {"verdict": claim["verdict"].replace("-", " ")}
            text += "| " + " | ".join(plain(cells[name]) for name in COLUMNS) + " |\n"
        text += "\nFigures: " + ", ".join(f"`{file}`" for file in entry.figures) + "\n" if entry.figures else ""
    return text


def read_ledger(text: str, name: str) -> list[Entry]:
    """The entries of the page. Throws LedgerError for anything that `reproduce` would not have written."""
    entries: list[Entry] = []
    for number, line in enumerate(text.splitlines(), 1):
        where = f"{name}:{number}"
        if heading := re.fullmatch(r"## (\S+): (.+)", line):
            entries.append(Entry(unescaped(heading[1]), unescaped(heading[2])))
        elif not entries:
            continue
        elif line.startswith("Skipped: "):
            entries[-1].skipped = unescaped(line.removeprefix("Skipped: "))
        elif line.startswith("Figures: "):
            entries[-1].figures = re.findall(r"`(figures/[\w.-]+\.svg)`", line)
        elif line.startswith("| ") and line + "\n" not in HEAD:
            entries[-1].claims.append(claim_of(line, where))
    expected, begin = markdown(entries), text.find("| verdict | claims |")
    actual = text[begin:] if begin >= 0 else ""
    if actual != expected:
        first = next((i for i, pair in enumerate(zip(actual, expected)) if pair[0] != pair[1]), min(len(actual), len(expected)))
        line = text[:begin].count("\n") + actual[:first].count("\n") + 1 if begin >= 0 else 1
        raise LedgerError(f"{name}:{line}: not as `incognita reproduce` writes it; at {actual[first:first + 60]!r} "
                          f"was expected {expected[first:first + 60]!r}")
    return entries
