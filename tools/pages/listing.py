"""Reads docs/numbers.toml: which commands make the numbers and pictures of README.md and docs/."""

import re
import tomllib
from dataclasses import dataclass, field
from pathlib import Path


class ListError(Exception):
    """The list or a page contradicts itself; the message names the entry and the remedy."""


@dataclass(frozen=True)
class Run:
    """Commands whose results blocks and pictures are made of."""

    id: str
    commands: str  # as a reader types them in the project's folder, one or more lines of shell
    seconds: float  # of processor time that they take, about
    recordings: str = ""  # folder of recorded data that they need, under data/ or ../shared/data
    sample: bool = False  # checked by every CI run
    timed: bool = False  # measures time: made only when asked for, never compared
    uses: tuple[str, ...] = ()  # runs whose results the commands read


@dataclass(frozen=True)
class Block:
    """A marked part of a page."""

    id: str
    page: str
    text: str  # an f-string over pages/results.py
    runs: tuple[str, ...]
    tolerance: float = 0.01  # relative, of each number


@dataclass(frozen=True)
class Picture:
    """A file copied from a run's folder."""

    id: str
    run: str
    file: str  # under out/docs/RUN
    to: str
    tolerance: float = 0.01  # PNG: mean difference of brightness; SVG: relative, of each number


@dataclass
class Listing:
    runs: dict[str, Run] = field(default_factory=dict)
    blocks: dict[str, Block] = field(default_factory=dict)
    pictures: dict[str, Picture] = field(default_factory=dict)


def made(kind, id: str, values: dict):
    """`kind` from a TOML table; a key that is missing or unknown is an error."""
    known = set(kind.__dataclass_fields__) - {"id"}
    unknown = sorted(set(values) - known)
    if unknown:
        raise ListError(f"{id}: there is no key `{unknown[0]}`; keys are {', '.join(sorted(known))}")
    values = {key: tuple(value) if isinstance(value, list) else value for key, value in values.items()}
    try:
        return kind(id=id, **values)
    except TypeError as error:
        raise ListError(f"{id}: {error}") from None


def read_list(path: Path) -> Listing:
    """Throws ListError for what is unknown, missing, or written outside the run's own folder."""
    with path.open("rb") as file:
        tables = tomllib.load(file)
    kinds = {"run": Run, "block": Block, "picture": Picture}
    unknown = sorted(set(tables) - set(kinds))
    if unknown:
        raise ListError(f"{path.name}: there is no table `{unknown[0]}`; tables are run, block and picture")
    listing = Listing(*({id: made(kind, id, values) for id, values in tables.get(word, {}).items()}
                        for word, kind in kinds.items()))
    for run in listing.runs.values():
        check_run(run, listing)
    for entry in (*listing.blocks.values(), *listing.pictures.values()):
        for run in runs_of(entry):
            if run not in listing.runs:
                raise ListError(f"{entry.id}: there is no run `{run}`")
    return listing


def check_run(run: Run, listing: Listing) -> None:
    for other in run.uses:
        if other not in listing.runs:
            raise ListError(f"{run.id}: there is no run `{other}`")
    for folder in re.findall(r"(?:--out|>)\s+(\S+)", run.commands):
        if not f"{folder}/".startswith(f"out/docs/{run.id}/"):
            raise ListError(f"{run.id}: writes {folder}; what a run writes belongs under out/docs/{run.id}")


def runs_of(entry: Block | Picture) -> tuple[str, ...]:
    return entry.runs if isinstance(entry, Block) else (entry.run,)
