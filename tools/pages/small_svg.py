"""Makes gnuplot's SVG smaller for the web: no empty groups, equal groups and lines of one color joined; what all groups
have in common stated once, the tics of an axis joined; lines and areas in tenths of a pixel, relative to the point before."""

import re

PATH = re.compile(r"\bd='([^']*)'")
POLYGON = re.compile(r"<polygon ([^>]*?)points = '([^']*)'")
EMPTY_GROUP = re.compile(r"\s*<g [^>]*>\s*</g>")
# A group with nothing but lines, and a following one with the same attributes; two lines of one color
EQUAL_GROUPS = re.compile(r"(<g [^>]*>)((?:\s*<path [^>]*/>)+)\s*</g>(?=\s*(<g [^>]*>)(?:\s*<path [^>]*/>)+\s*</g>)")
EQUAL_LINES = re.compile(r"(<path stroke='[^']*'  d=)'[^']*'/>(?:\s*\1'[^']*'/>)+")
# What gnuplot states again in each group: of lines, which are no part of each other, and of texts within them
CANVAS = '<g id="gnuplot_canvas">'
OF_LINES = ('fill="none"', 'color="black"', 'stroke="currentColor"', 'stroke-linecap="round"', 'stroke-linejoin="round"')
OF_TEXTS = ('font-family="DejaVu Sans"', 'font-size="13.00"')
GROUP = re.compile(r"<g (fill=\"none\" color=|transform=)[^>]*>")
BACKGROUND = re.compile(r"(<rect x=\"0\" y=\"0\" [^>]*?)/>")
# A tic: its line through the panel, its mark on the axis, its number
TIC = re.compile(r"(<g\b[^>]*><path [^>]*class=\"gridline\"  d=)'([^']*)'/></g>"
                 r"(<g\b[^>]*><path stroke='[^']*'  d=)'([^']*)'/>(<g\b[^>]*><text>[^<]*</text></g>)</g>")
BETWEEN = re.compile(r">\s+(?=</?(?:g|path|text)\b)")
COLOR = re.compile(r"rgb\(\s*(\d+),\s*(\d+),\s*(\d+)\)")
POINT = re.compile(r"([ML])\s*(-?\d+(?:\.\d+)?),(-?\d+(?:\.\d+)?)")


def tenths(number: int) -> str:
    text = f"{number / 10:.1f}".removesuffix(".0")
    return text.replace("0.", ".", 1) if text.startswith(("0.", "-0.")) else text


def small_path(path: str) -> str:
    """Only moves and lines; any other path stays as it is."""
    points = POINT.findall(path)
    if POINT.sub("", path).strip() or not points:
        return path
    text, x, y, command = "", 0, 0, ""
    for kind, u, v in points:
        to_x, to_y = round(float(u) * 10), round(float(v) * 10)
        if kind == "M":
            text += f"M{tenths(to_x)},{tenths(to_y)}"
        elif (to_x, to_y) == (x, y) and command == "L":
            continue  # shorter than can be seen
        else:
            step = f"{tenths(to_x - x)},{tenths(to_y - y)}"
            text += ("l" if command != "L" else "" if step.startswith("-") else " ") + step
        x, y, command = to_x, to_y, kind
    return text


def area_as_path(match: re.Match) -> str:
    corners = "M" + " L".join(match[2].split())
    return f"<path {match[1]}d='{small_path(corners)}z'"


def joined_groups(text: str) -> str:
    """Leaves out the end of a group and the beginning of the next where both have the same attributes."""
    parts, done = [], 0
    for match in EQUAL_GROUPS.finditer(text):
        if match[1] != match[3]:
            continue
        parts.append(text[done:match.end(2)])
        done = match.end(3)
    return "".join(parts) + text[done:]


def joined_lines(match: re.Match) -> str:
    return f"{match[1]}'" + "".join(PATH.findall(match[0])) + "'/>"


def stated_once(text: str) -> str:
    head, canvas, groups = text.partition(CANVAS)
    if not canvas:
        return text

    def without(match: re.Match) -> str:
        group = match[0]
        for attribute in OF_LINES if match[1].startswith("fill") else OF_TEXTS:
            group = group.replace(" " + attribute, "")
        return group

    groups = BACKGROUND.sub(r'\1 stroke="none"/>', groups, count=1)
    return " ".join((head + canvas[:-1], *OF_LINES, *OF_TEXTS)) + ">" + GROUP.sub(without, groups)


def joined_tics(text: str) -> str:
    """One path for the lines of neighboring tics, and one for their marks."""
    parts, done, axis = [], 0, []

    def end_axis() -> None:
        if axis:
            lines, marks = ("".join(match[k] for match in axis) for k in (2, 4))
            parts.append(f"{axis[0][1]}'{lines}'/></g>{axis[0][3]}'{marks}'/>" + "".join(match[5] for match in axis) + "</g>")
            axis.clear()

    for match in TIC.finditer(text):
        if match.start() != done or axis and axis[0].group(1, 3) != match.group(1, 3):
            end_axis()
            parts.append(text[done:match.start()])
        axis.append(match)
        done = match.end()
    end_axis()
    return "".join(parts) + text[done:]


def small_svg(text: str) -> str:
    """Looks the same to a tenth of a pixel."""
    text = PATH.sub(lambda match: f"d='{small_path(match[1])}'", text)
    text = POLYGON.sub(area_as_path, text)
    while (shorter := EMPTY_GROUP.sub("", text)) != text:
        text = shorter
    text = stated_once(EQUAL_LINES.sub(joined_lines, joined_groups(text)))
    text = COLOR.sub(lambda match: "#" + bytes(map(int, match.groups())).hex(), BETWEEN.sub(">", text))
    return joined_tics(text)
