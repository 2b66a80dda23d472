"""The generated parts of a page, between `<!-- generated: ID -->` and `<!-- end -->`, each on a line of its own."""

import re
from dataclasses import dataclass

from pages.listing import ListError

BEGIN = re.compile(r"^( *)<!-- generated: ([a-z0-9-]+) -->$")
END = re.compile(r"^ *<!-- end -->$")


@dataclass(frozen=True)
class Marked:
    id: str
    indent: str
    first: int  # line of the page, from 0, after the opening marker
    last: int  # line of the closing marker
    text: str  # without the indentation


def marked_parts(page: str, text: str) -> list[Marked]:
    """Throws ListError for a marker without its partner."""
    lines, parts, open_at = text.split("\n"), [], None
    for number, line in enumerate(lines):
        begin = BEGIN.match(line)
        if begin and open_at is None:
            open_at = (number, begin)
        elif begin or (END.match(line) and open_at is None):
            raise ListError(f"{page}:{number + 1}: `{line.strip()}` without its partner")
        elif END.match(line):
            start, begin = open_at
            inside = "\n".join(inner.removeprefix(begin[1]) for inner in lines[start + 1:number])
            parts.append(Marked(begin[2], begin[1], start + 1, number, inside))
            open_at = None
        elif "<!-- generated" in line or "<!-- end" in line:
            raise ListError(f"{page}:{number + 1}: `{line.strip()}` is no marker; write `<!-- generated: ID -->` or "
                            "`<!-- end -->`, alone on the line")
    if open_at is not None:
        raise ListError(f"{page}:{open_at[0] + 1}: `{open_at[1][0].strip()}` is never closed by `<!-- end -->`")
    return parts


def replaced(text: str, part: Marked, new: str) -> str:
    lines = text.split("\n")
    lines[part.first:part.last] = [(part.indent + line).rstrip() for line in new.split("\n")]
    return "\n".join(lines)
