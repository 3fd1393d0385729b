"""Draws what a program of this folder wrote with --json: cost over level, a panel for each task and precision.

usage: plot.py JSON SVG
"""

import json
import math
import pathlib
import sys
from xml.sax.saxutils import escape

WIDTH, HEIGHT = 430, 330  # of a panel
LEFT, RIGHT, TOP, BOTTOM = 56, 14, 34, 44
COLOURS = {"ours": "#0072b2", "opensubdiv-far": "#d55e00", "opensubdiv-bfr": "#d55e00",
           "opensubdiv-stencils": "#e69f00", "openmesh": "#009e73", "cgal": "#cc79a7"}


def stroke(name, threads):
    """A colour for each name, dashed for two threads."""
    dashes = 'stroke-dasharray="6 3"' if threads == 2 else ""
    return f'stroke="{COLOURS.get(name, "#777777")}" stroke-width="1.8" {dashes}'


def series(cases):
    """{(name, threads): {level: ns}} of the cases of one panel; with `write`, what nobody can beat."""
    found = {}
    for case in cases:
        for threads, ns in enumerate(case["write_ns"], 1):
            found.setdefault(("write", threads), {})[case["level"]] = ns
        for subject in case["subjects"]:
            if subject.get("ns"):
                found.setdefault((subject["name"], subject["threads"]), {})[case["level"]] = subject["ns"]
    return found


def text(x, y, content, anchor="middle", size=11, more=""):
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" font-size="{size}"{more}>{escape(content)}</text>'


def line(x0, y0, x1, y1, style):
    return f'<line x1="{x0:.1f}" y1="{y0:.1f}" x2="{x1:.1f}" y2="{y1:.1f}" {style}/>'


def ticks(low, high):
    """1, 2 and 5 times the powers of ten from one decade's end to another's."""
    return [m * 10.0**e for e in range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1) for m in (1, 2, 5)
            if low <= m * 10.0**e <= high]


def panel(title, cases, item):
    """The elements of one panel, at the origin."""
    lines = series(cases)
    levels = sorted({level for points in lines.values() for level in points})
    values = [ns for points in lines.values() for ns in points.values()]
    low, high = min(values) / 1.3, max(values) * 1.3
    right, bottom = WIDTH - RIGHT, HEIGHT - BOTTOM

    def x_of(level):
        return LEFT + (right - LEFT) * (level - levels[0] + 0.25) / (levels[-1] - levels[0] + 0.5)

    def y_of(ns):
        return bottom - (bottom - TOP) * math.log(ns / low) / math.log(high / low)

    out = [text(WIDTH / 2, 20, title, size=13)]
    for ns in ticks(low, high):
        out += [line(LEFT, y_of(ns), right, y_of(ns), 'stroke="#dddddd"'),
                text(LEFT - 5, y_of(ns) + 4, f"{ns:g}", "end")]
    out += [text(x_of(level), bottom + 15, str(level)) for level in levels]
    middle = (TOP + bottom) / 2
    out += [text((LEFT + right) / 2, bottom + 32, "level"),
            text(14, middle, f"ns per {item}", more=f' transform="rotate(-90 14 {middle:.1f})"'),
            f'<path d="M{LEFT} {TOP}V{bottom}H{right}" fill="none" stroke="#333333"/>']
    for (name, threads), points in lines.items():
        places = [(x_of(level), y_of(points[level])) for level in sorted(points)]
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in places)
        out.append(f'<polyline points="{path}" fill="none" {stroke(name, threads)}/>')
        out += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="1.5" {stroke(name, 1)}/>' for x, y in places]
    return out


def legend(keys, width):
    """What the lines mean, in a row under the panels that is broken where it is full; and its height."""
    out, x, y = [], LEFT, 14
    for name, threads in keys:
        label = name + (", 2 threads" if threads == 2 else "")
        if x + 44 + 7 * len(label) > width:
            x, y = LEFT, y + 18
        out += [line(x, y - 4, x + 28, y - 4, stroke(name, threads)), text(x + 34, y, label, "start")]
        x += 54 + 7 * len(label)
    return out, y + 12


def figure(report):
    """The report as SVG."""
    panels = {}
    for case in report["cases"]:
        panels.setdefault(f'{case["task"]}, {case["precision"]}', []).append(case)
    columns = min(2, len(panels))
    rows = math.ceil(len(panels) / columns)
    keys = dict.fromkeys(key for cases in panels.values() for key in series(cases))
    width = columns * WIDTH
    names, names_height = legend(keys, width)
    height = rows * HEIGHT + names_height
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif">',
           f'<title>{escape(report["program"])} on {escape(report["machine"]["processor"])}</title>',
           f'<rect width="{width}" height="{height}" fill="white"/>']
    for i, (title, cases) in enumerate(panels.items()):
        out.append(f'<g transform="translate({i % columns * WIDTH} {i // columns * HEIGHT})">')
        out += panel(title, cases, report["item"])
        out.append("</g>")
    out += [f'<g transform="translate(0 {rows * HEIGHT})">', *names, "</g>", "</svg>"]
    return "\n".join(out) + "\n"


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    source, target = map(pathlib.Path, sys.argv[1:])
    drawing = figure(json.loads(source.read_text()))
    beside = target.with_name(target.name + ".new")
    beside.write_text(drawing)
    beside.replace(target)


if __name__ == "__main__":
    main()
