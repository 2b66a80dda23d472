"""The static page of the claims ledger: its claims.json, and the files of web/laboratory with relative addresses."""

import json
import re
from pathlib import Path

from pages.ledger import COLUMNS, Entry, LedgerError

PAGE = "laboratory/claims.html"
REPLACED = {'href="../theme.css"': 'href="theme.css"', 'data-files="../files/"': 'data-files="./"'}


class Known:
    """What earlier results say of the claims of docs/claims.md beyond it: ids, and numbers of runs."""

    def __init__(self, entries: list[Entry]):
        self.entries = {entry.id: entry for entry in entries}
        self.of_claim: dict[tuple, dict] = {}

    def add(self, file: Path, remarks: list[str] | None = None) -> list[Entry]:
        """Returns the entries whose results agree with docs/claims.md."""
        try:
            document = json.loads(file.read_text())
            return [entry for old in document if (entry := self.add_entry(old, file, remarks))]
        except (ValueError, KeyError, TypeError) as error:
            raise LedgerError(f"{file} is not what `incognita reproduce` writes: {type(error).__name__}: {error}") from None

    def add_entry(self, old: dict, file: Path, remarks: list[str] | None) -> Entry | None:
        entry = self.entries.get(old["id"])
        if entry is None or old.get("skipped"):
            return None
        before = {(claim["place"], claim["statement"]): claim for claim in old["claims"]}
        same, verdicts = 0, 0
        for claim in entry.claims:
            was = before.get((claim["place"], claim["statement"]))
            if was is None:
                continue
            # line breaks are blanks in the page
            equal = all(re.sub(r"[\r\n]", " ", was[name]) == claim[name] for name in COLUMNS)
            same += equal
            verdicts += was["verdict"] == claim["verdict"]
            facts = self.of_claim.setdefault((entry.id, claim["place"], claim["statement"]), {})
            facts["id"] = was["id"]
            if equal and "runs" in was:
                facts |= {"runs": was["runs"], "least_runs": was["least_runs"]}
        count = max(len(entry.claims), len(before))
        # Timings differ from run to run, so not every word can be asked for
        agrees = verdicts == count and 4 * same >= 3 * count
        if remarks is not None and same < count:
            remarks.append(f"{file}, {entry.id}: {count - same} of {count} claims differ from docs/claims.md" +
                           ("" if agrees else "; its figures are not taken"))
        return entry if agrees else None


def id_of(entry: Entry, statement: str, taken: set[str]) -> str:
    """An id made of the first words of the statement, for a claim that no result names."""
    words = re.findall(r"[a-z0-9]+", statement.lower())
    for count in range(min(5, len(words)), len(words) + 1):
        if (id := "-".join([entry.id, *words[:count]])) not in taken:
            return id
    number = 2
    while (id := "-".join([entry.id, *words, str(number)])) in taken:
        number += 1
    return id


def claims_json(entries: list[Entry], known: Known, out: Path) -> str:
    document, taken = [], {facts["id"] for facts in known.of_claim.values()}
    for entry in entries:
        claims = []
        for claim in entry.claims:
            facts = known.of_claim.get((entry.id, claim["place"], claim["statement"]), {})
            id = facts.get("id") or id_of(entry, claim["statement"], taken)
            taken.add(id)
            claims.append({"id": id} | claim | {name: facts[name] for name in ("runs", "least_runs") if name in facts})
        # A figure that is not in the folder keeps its name, so that the page can say how to draw it
        figures = [{"id": Path(name).stem, "file": name if (out / name).exists() else "", "data": ""} for name in entry.figures]
        skipped = {"skipped": entry.skipped} if entry.skipped else {}
        document.append({"id": entry.id, "title": entry.title} | skipped | {"claims": claims, "figures": figures})
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
