"""The static page of the claims ledger: its claims.json, and the files of web/laboratory with relative addresses."""

import json
import re
from pathlib import Path

PAGE = "laboratory/claims.html"
REPLACED = {'href="../theme.css"': 'href="theme.css"', 'data-files="../files/"': 'data-files="./"'}
FIELDS = ("id", "origin", "place", "statement", "printed", "measured", "rule", "finding", "verdict", "why", "runs", "least_runs")


class LedgerError(Exception):
    """A file is not what `incognita reproduce` writes."""


def read_ledger(file: Path) -> list[dict]:
    """The entries of claims.json."""
    try:
        document = json.loads(file.read_text())
        for entry in document:
            absent = [name for name in ("id", "title", "claims", "figures") if name not in entry]
            absent += [f"{claim.get('id', '?')}: {name}" for claim in entry["claims"] for name in FIELDS if name not in claim]
            if absent:
                raise KeyError(absent[0])
        return document
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise LedgerError(f"{file} is not what `incognita reproduce` writes: {type(error).__name__}: {error}") from None


def claims_json(entries: list[dict], out: Path) -> str:
    """As `incognita reproduce` writes it; a figure that is not in the folder keeps its name, so that the page can say how
    to draw it."""
    document = []
    for entry in entries:
        figures = [{"id": figure["id"], "file": name if (out / name).exists() else "", "data": ""}
                   for figure in entry["figures"] for name in [f"figures/{figure['id']}.svg"]]
        document.append(entry | {"figures": figures})
    return json.dumps(document, indent=1, ensure_ascii=False) + "\n"


def page_files(web: Path) -> dict[str, str]:
    """The page as index.html, and its modules and styles, by name."""
    page = (web / PAGE).read_text()
    for old, new in REPLACED.items():
        if page.count(old) != 1:
            raise LedgerError(f"web/{PAGE}: {old} stands there {page.count(old)} times, not once")
        page = page.replace(old, new)
    if left := re.findall(r'(?:href|src|data-files)="(?:\.\./|/|https?:)[^"]*"', page):
        raise LedgerError(f"web/{PAGE}: {left[0]} leads out of the folder")
    files = {"index.html": page, "theme.css": (web / "theme.css").read_text()}
    for pattern in ("laboratory.css", "claims/*.css", "claims/*.js", "shared/*.js"):
        for file in sorted((web / "laboratory").glob(pattern)):
            files[str(file.relative_to(web / "laboratory"))] = file.read_text()
    return files
