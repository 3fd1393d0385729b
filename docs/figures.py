"""Draws the figures of README.md and docs/ from what loopcheck writes.  Run by scripts/figures.

usage: figures.py LOOPCHECK MODELS OUTPUT
"""

import json
import math
import pathlib
import subprocess
import sys
import tempfile

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from mpl_toolkits.mplot3d.art3d import Poly3DCollection  # noqa: E402


def read_obj(path):
    """Vertices (n x 3) and triangles (m x 3, from 0)."""
    lines = [line.split() for line in pathlib.Path(path).read_text().splitlines()]
    vertices = np.array([[float(x) for x in line[1:4]] for line in lines if line[:1] == ["v"]])
    faces = np.array([[int(x) - 1 for x in line[1:4]] for line in lines if line[:1] == ["f"]])
    return vertices, faces


def shaded(vertices, faces, colour):
    """One colour a face, lit from the upper left."""
    a, b, c = (vertices[faces[:, i]] for i in range(3))
    normal = np.cross(b - a, c - a)
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-30)
    light = np.array([0.4, 0.75, 0.55]) / math.sqrt(0.4**2 + 0.75**2 + 0.55**2)
    amount = 0.5 + 0.5 * np.clip(normal @ light, 0, 1)
    return np.clip(np.atleast_2d(colour)[:, :3] * amount[:, None], 0, 1)


def draw(axes, vertices, faces, colour, edges, zoom):
    """A mesh with y up, seen from its left front."""
    turned = vertices[:, [0, 2, 1]] * [1, -1, 1]
    axes.add_collection3d(Poly3DCollection(turned[faces], facecolors=shaded(vertices, faces, colour),
                                           edgecolors=(0.1, 0.1, 0.1, 0.6) if edges else "none",
                                           linewidths=0.25 if edges else 0, antialiased=edges))
    low, high = turned.min(axis=0), turned.max(axis=0)
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]))
    axes.set_proj_type("ortho")
    axes.set_box_aspect(high - low, zoom=zoom)
    axes.view_init(elev=14, azim=-62)
    axes.set_axis_off()


def refined(loopcheck, model, folder, *flags):
    """What `loopcheck refine` makes of a model: vertices and triangles."""
    path = pathlib.Path(folder) / "refined.obj"
    subprocess.run([loopcheck, "refine", model, "-o", path, *flags], check=True, stdout=subprocess.DEVNULL)
    return read_obj(path)


def draw_levels(loopcheck, model, output, folder):
    """The control mesh and three levels, side by side."""
    figure = plt.figure(figsize=(13, 3.1))
    for level in range(4):
        vertices, faces = refined(loopcheck, model, folder, "--levels", str(level))
        axes = figure.add_subplot(1, 4, level + 1, projection="3d")
        draw(axes, vertices, faces, (0.86, 0.80, 0.72), edges=level < 2, zoom=1.3)
        name = "control mesh" if level == 0 else f"level {level}"
        axes.set_title(f"{name}: {len(faces)} faces", fontsize=9, y=-0.02)
    figure.subplots_adjust(0, 0.04, 1, 1, 0, 0)
    figure.savefig(output, dpi=110)


def draw_lab_figures(loopcheck, model, output, folder):
    """The lab report's figures 3 and 4: Loop's scheme, and its adaptive variant as the report's program had it."""
    adaptive = ["--adaptive", "--neighbours", "first-vertex-ring"]
    figure = plt.figure(figsize=(13, 6.2))
    for row, (flags, name) in enumerate([([], "Loop"), (adaptive, "adaptive")]):
        for level in range(4):
            vertices, faces = refined(loopcheck, model, folder, "--levels", str(level), *flags)
            axes = figure.add_subplot(2, 4, 4 * row + level + 1, projection="3d")
            draw(axes, vertices, faces, (0.86, 0.80, 0.72), edges=True, zoom=1.3)
            axes.set_title(f"{name}, level {level}: {len(faces)} faces", fontsize=9, y=-0.02)
    figure.subplots_adjust(0, 0.02, 1, 1, 0, 0.06)
    figure.savefig(output, dpi=110)
    plt.close(figure)


def draw_three_ways(loopcheck, model, output, folder):
    """What is sharp kept in two ways, lit; and the triangles that a tolerance takes."""
    ways = [("adaptive, 60 degrees, level 4", ["--adaptive", "--levels", "4"]),
            ("creases, 60 degrees, level 4", ["--crease-angle", "60", "--levels", "4"]),
            ("within 0.02 of the limit", ["--tolerance", "0.02"])]
    figure = plt.figure(figsize=(15, 4.4))
    for column, (name, flags) in enumerate(ways):
        vertices, faces = refined(loopcheck, model, folder, *flags)
        axes = figure.add_subplot(1, 3, column + 1, projection="3d")
        draw(axes, vertices, faces, (0.86, 0.80, 0.72), edges=column == 2, zoom=1.36)
        axes.set_title(f"{name}: {len(faces)} faces", fontsize=10, y=-0.02)
    figure.subplots_adjust(0, 0.04, 1, 1, 0, 0)
    figure.savefig(output, dpi=100)
    plt.close(figure)


def draw_patterns(output):
    """How a triangle is replaced, by the edges that are split."""
    corners = np.array([[0, 0], [1, 0], [0.5, 0.87]])
    middles = (corners + np.roll(corners, -1, axis=0)) / 2
    a, b, c, ab, bc, ca = range(6)
    patterns = [("all edges split", [(a, ab, ca), (ab, b, bc), (ca, bc, c), (bc, ca, ab)], []),
                ("ab is not", [(a, b, bc), (bc, c, ca), (ca, a, bc)], [(a, b)]),
                ("only ab is", [(a, ab, c), (ab, b, c)], [(b, c), (c, a)]),
                ("none is", [(a, b, c)], [(a, b), (b, c), (c, a)])]
    points = np.vstack([corners, middles])
    figure, all_axes = plt.subplots(1, 4, figsize=(9, 2.3))
    for axes, (title, triangles, unsplit) in zip(all_axes, patterns):
        for triangle in triangles:
            axes.fill(*points[list(triangle)].T, facecolor="#dbe9f4", edgecolor="0.3", linewidth=1)
        for edge in unsplit:
            axes.plot(*points[list(edge)].T, color="#d55e00", linewidth=3)
        for name, point, shift in zip("abc", corners, [(-0.08, -0.05), (0.08, -0.05), (0, 0.09)]):
            axes.text(*(point + shift), name, ha="center", va="center", fontsize=9)
        axes.set_title(title, fontsize=9)
        axes.set_aspect("equal")
        axes.margins(0.1)
        axes.set_axis_off()
    figure.subplots_adjust(0.01, 0.01, 0.99, 0.88, 0.05, 0)
    figure.savefig(output, dpi=100)
    plt.close(figure)


def draw_weights(axes, mesh, weights, title):
    """A flat mesh with a weight at every vertex: area by size, blue above 0, orange below; sharp edges thick."""
    points = np.array(mesh["positions"])[:, :2]
    for triangle in mesh["triangles"]:
        axes.fill(*points[triangle].T, facecolor="none", edgecolor="0.75", linewidth=0.8, zorder=1)
    for a, b, sharpness in mesh["sharp_edges"]:
        axes.plot(*points[[a, b]].T, color="0.25", linewidth=2.4, zorder=2)
        if sharpness < 10:
            axes.annotate(f"{sharpness:.3g}", points[[a, b]].mean(axis=0), xytext=(0, -4), va="top", ha="center",
                          textcoords="offset points", fontsize=7, color="0.25", zorder=5)
    scale = 900 / max(np.abs(weights).max(), 1e-30)
    colours = np.where(np.array(weights) < 0, "#d55e00", "#0072b2")
    axes.scatter(*points.T, s=np.abs(weights) * scale + 3, c=colours, alpha=0.35, linewidths=0, zorder=3)
    for vertex, sharpness in mesh["sharp_vertices"]:
        axes.scatter(*points[vertex], s=140, marker="s", facecolors="none", edgecolors="0.25", zorder=4)
    for point, weight in zip(points, weights):
        if abs(weight) > 2e-4 * max(np.abs(weights)):
            axes.text(*point, f"{weight:.4g}", fontsize=7.5, ha="center", va="center", zorder=6)
    axes.set_title(title, fontsize=9)
    axes.set_aspect("equal")
    axes.margins(0.12)
    axes.set_axis_off()


def draw_deviations(loopcheck, output, folder):
    """For every known deviation the two rows of weights on its smallest mesh."""
    report = pathlib.Path(folder) / "deviations.json"
    subprocess.run([loopcheck, "deviations", "--json", report], check=True, stdout=subprocess.DEVNULL)
    for shown in json.loads(report.read_text())["deviations"]:
        rows = [(shown["exact"], shown["columns"][0]), (shown["observed"], shown["columns"][1])]
        figure, both = plt.subplots(1, 2, figsize=(8.4, 4.0))
        for axes, (weights, title) in zip(both, rows):
            if len(weights) == 1:
                title = f"{title}: {weights[0]:.10g}"
                weights = [0.0] * len(shown["mesh"]["positions"])
            draw_weights(axes, shown["mesh"], weights, title)
        figure.suptitle(f"{shown['name']}: {shown['quantity']}", fontsize=9, wrap=True)
        figure.subplots_adjust(0.01, 0.01, 0.99, 0.86, 0.02, 0)
        figure.savefig(output / f"{shown['name']}.png", dpi=100)
        plt.close(figure)


class SectorMesh:
    """The vertex and `rings` rings of it: n triangular sectors, all around or, if open, from edge 0 to edge n.

    A vertex is named by its ring r and its place t in it, sector * r + steps.
    """

    def __init__(self, n, rings, is_open, dart):
        self.n, self.rings, self.open, self.dart = n, rings, is_open, dart
        self.index, self.faces, self.edges = {}, [], {}
        for s in range(n):
            for i in range(rings):
                for j in range(rings - i):
                    self._add(s, [(i, j), (i + 1, j), (i, j + 1)])
                    if i + j < rings - 1:
                        self._add(s, [(i + 1, j), (i + 1, j + 1), (i, j + 1)])

    def name(self, s, i, j):
        r = i + j
        t = s * r + j
        return r, t if self.open or r == 0 else t % (self.n * r)

    def _add(self, s, corners):
        names = [self.name(s, *c) for c in corners]
        self.faces.append([self.index.setdefault(name, len(self.index)) for name in names])
        for k in range(3):  # edges are numbered as they are first met, and named by twice their middle
            (i, j), (x, y) = corners[k], corners[(k + 1) % 3]
            self.edges.setdefault(self.name(s, i + x, j + y), len(self.edges))

    def start(self):
        """A regular polygon around the vertex; half of one if open."""
        points = np.zeros((len(self.index), 2))
        turn = (1 if self.open else 2) * math.pi / self.n
        for (r, t), v in self.index.items():
            s, j = divmod(t, r) if r else (0, 0)
            for weight, angle in ((r - j, turn * s), (j, turn * (s + 1))):
                points[v] += weight * np.array([math.cos(angle), math.sin(angle)])
        return points

    def write(self, path, points):
        lines = [f"v {x!r} {y!r} 0" for x, y in points.tolist()]
        lines += ["f " + " ".join(str(v + 1) for v in face) for face in self.faces]
        if self.dart:
            ends = [self.index[r, 0] for r in range(self.rings + 1)]
            pairs = " ".join(f"{a} {b}" for a, b in zip(ends, ends[1:]))
            lines.append(f"t crease {2 * self.rings}/1/0 {pairs} 10")
        pathlib.Path(path).write_text("\n".join(lines) + "\n")

    def refined(self, loopcheck, points, folder):
        """The same rings, one level later."""
        control, fine = pathlib.Path(folder) / "rings.obj", pathlib.Path(folder) / "fine.obj"
        self.write(control, points)
        subprocess.run([loopcheck, "refine", control, "-o", fine, "--levels", "1", "--boundary", "edge-only"],
                       check=True, stdout=subprocess.DEVNULL)
        vertices, _ = read_obj(fine)
        out = np.zeros_like(points)
        for (r, t), v in self.index.items():
            old = self.index.get((r // 2, t // 2)) if r % 2 == 0 and t % 2 == 0 else None
            child = len(points) + self.edges[r, t] if old is None else old
            out[v] = vertices[child, :2]
        return out

    def limits(self, loopcheck, points, folder):
        """Right for all but the last ring."""
        control = pathlib.Path(folder) / "rings.obj"
        self.write(control, points)
        text = subprocess.run([loopcheck, "stencils", control, "--limit", "--boundary", "edge-only"], check=True,
                              capture_output=True, text=True).stdout
        rows = np.array([line.split() for line in text.splitlines() if line[0] != "%"][1:], dtype=float)
        out = np.zeros_like(points)
        np.add.at(out, rows[:, 0].astype(int) - 1, rows[:, 2:] * points[rows[:, 1].astype(int) - 1])
        return out


def characteristic_map(loopcheck, mesh, points, folder):
    """The rings in the plane of the tangents, and the eigenvalue of each axis, by refining again and again."""
    centre = mesh.index[0, 0]
    for _ in range(60):
        points = points - mesh.limits(loopcheck, points, folder)[centre]
        points = points / np.abs(points).max(axis=0)
        refined = mesh.refined(loopcheck, points, folder)
        factors = np.abs(refined - mesh.limits(loopcheck, refined, folder)[centre]).max(axis=0)
        points = refined
    limits = mesh.limits(loopcheck, points, folder)
    limits = (limits - limits[centre]) / np.abs(limits - limits[centre]).max(axis=0)
    return limits, factors


def draw_characteristic_maps(loopcheck, output, folder):
    """Two rings of triangles a level, for four levels, around vertices of six kinds."""
    cases = [(f"smooth, valence {n}", SectorMesh(n, 5, False, False)) for n in (3, 5, 8)]
    cases += [("boundary, 4 faces", SectorMesh(4, 5, True, False)), ("dart, valence 5", SectorMesh(5, 5, False, True)),
              ("boundary, 7 faces: folded", SectorMesh(7, 5, True, False))]
    colours = ["#e3e9f1", "#b4c5da", "#7d9bbd", "#4a6f99"]
    figure, panels = plt.subplots(2, 3, figsize=(9, 5.8))
    for axes, (title, mesh) in zip(panels.flat, cases):
        start = mesh.start()
        folded = mesh.open and mesh.n == 7
        if folded:  # the two waves that win, which are 0 on the boundary
            for (r, t), v in mesh.index.items():
                angle = math.pi * t / (mesh.n * r) if r else 0
                start[v] = r * np.array([math.sin(angle), math.sin(2 * angle)])
        points, factors = characteristic_map(loopcheck, mesh, start, folder)
        ring = {v: r for (r, _), v in mesh.index.items()}
        for level in range(4):
            scaled = points * factors**level
            for face in mesh.faces:
                if all(2 <= ring[v] <= 4 for v in face) or (level == 3 and all(ring[v] <= 2 for v in face)):
                    axes.fill(*scaled[face].T, facecolor=colours[level], edgecolor="#333333", linewidth=0.45,
                              alpha=0.55 if folded else 1)
        for sharp in [0, mesh.n] if mesh.open else [0] if mesh.dart else []:
            line = points[[mesh.index[r, sharp * r] for r in range(5)]]
            axes.plot(*line.T, color="#b3261e", linewidth=1.8)
        axes.plot(0, 0, "o", color="#b3261e" if folded else "black", markersize=3.5)
        shown = " and ".join(dict.fromkeys(f"{factor:.4f}" for factor in factors))
        axes.set_title(f"{title}\neach level smaller by {shown}", fontsize=9)
        axes.set_aspect("equal" if not folded else "auto")
        axes.set_axis_off()
    figure.tight_layout()
    figure.savefig(output, dpi=80)
    plt.close(figure)


def loop_eigenvalue(turn):
    return 3 / 8 + math.cos(turn) / 4


def dart_eigenvalue(n):
    """The even tangent's: bisection of 8 (mu - 1/2)(mu - lambda^2) = b tan(n phi/2) / tan(phi/2)."""
    bowl = loop_eigenvalue(2 * math.pi / n)**2

    def excess(phi):
        mu = loop_eigenvalue(phi)
        return (8 * (mu - 0.5) * (mu - bowl) - (0.625 - bowl) / n * math.tan(n * phi / 2) / math.tan(phi / 2))

    low, high = math.pi / n * (1 + 1e-9), min(math.pi, 3 * math.pi / n) * (1 - 1e-9)
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if excess(middle) > 0 else (low, middle)
    return loop_eigenvalue(low)


def draw_eigenvalues(output):
    """Which eigenvalues are the largest after 1: around smooth vertices and darts, and in a sector."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 3.9), sharey=True)
    valences = range(3, 17)
    smooth = [loop_eigenvalue(2 * math.pi / n) for n in valences]
    left.plot(valences, smooth, "o-", color="#1f4e79", label="smooth and dart: tangents, lambda")
    left.plot(valences, [dart_eigenvalue(n) for n in valences], "D-", color="#b3261e", markersize=5,
              label="dart: even tangent")
    left.plot(valences, [x * x for x in smooth], "s--", color="#6c8ebf", markersize=4, label="smooth: bowl, lambda^2")
    left.plot(valences[1:], [loop_eigenvalue(4 * math.pi / n) for n in valences[1:]], "^--", color="#7a7a7a",
              markersize=4, label="smooth: saddle, wave 2")
    left.set(xlabel="valence n", title="around a vertex", ylabel="eigenvalue", xticks=range(3, 17, 1))
    faces = range(1, 13)
    right.axvspan(6.5, 12.4, color="#b3261e", alpha=0.08, linewidth=0)
    right.plot([k for k in faces if k > 1], [loop_eigenvalue(math.pi / k) for k in faces if k > 1], "o-",
               color="#1f4e79", label="wave 1")
    right.plot([k for k in faces if k > 2], [loop_eigenvalue(2 * math.pi / k) for k in faces if k > 2], "^-",
               color="#7a7a7a", label="wave 2")
    right.plot(faces, [0.5] * len(faces), "s-", color="#b3261e", markersize=4,
               label="the sharp edges: crease 1/2, corner 1/2 twice")
    right.plot(faces, [0.25] * len(faces), "s--", color="#d98880", markersize=4, label="crease: 1/4")
    right.annotate("corner: from 4 faces on wave 1 wins,\nno normal", (4, loop_eigenvalue(math.pi / 4)), (1.0, 0.645),
                   fontsize=8, arrowprops={"arrowstyle": "->", "linewidth": 0.7})
    right.annotate("crease: from 7 faces on\nwaves 1 and 2 win, no normal",
                   (7, loop_eigenvalue(2 * math.pi / 7)), (7.3, 0.35), fontsize=8,
                   arrowprops={"arrowstyle": "->", "linewidth": 0.7})
    right.set(xlabel="faces k in the sector", title="in a sector of a crease, boundary or corner", xticks=faces,
              xlim=(0.6, 12.4))
    for axes in (left, right):
        axes.axhline(0.5, color="black", linewidth=0.6, linestyle=":")
        axes.grid(alpha=0.25)
        axes.set_ylim(0, 0.72)
        axes.legend(fontsize=7.5, loc="lower right")
    figure.tight_layout()
    figure.savefig(output, dpi=100)
    plt.close(figure)


def lattice(i, j):
    """Points (i, j) of the triangular lattice."""
    return np.array([i + j / 2, j * math.sqrt(3) / 2])


def draw_twelve_points(output):
    """The points of a regular triangle; where its lower edge is sharp, those beyond it are phantoms."""
    corners = [(0, 0), (1, 0), (0, 1)]
    points = corners + [(1, -1), (1, 1), (-1, 1), (-1, 0), (0, -1), (2, -1), (2, 0), (0, 2), (-1, 2)]
    kinds = ["corner"] * 3 + ["across"] * 3 + ["outer"] * 6
    colours = {"corner": "#1f4e79", "across": "#2e7d32", "outer": "#8d6e63"}
    triangles = [[(i, j), (i + 1, j), (i, j + 1)] for i in range(-2, 3) for j in range(-2, 3)]
    triangles += [[(i + 1, j), (i + 1, j + 1), (i, j + 1)] for i in range(-2, 3) for j in range(-2, 3)]
    figure, panels = plt.subplots(1, 2, figsize=(9.6, 4.3))
    for sharp, axes in enumerate(panels):
        for triangle in triangles:
            if all(c in points for c in triangle):
                beyond = sharp and min(j for _, j in triangle) < 0
                axes.fill(*np.array([lattice(*c) for c in triangle]).T, linewidth=0.8,
                          facecolor="#cfe0f3" if triangle == corners else "none", edgecolor="#999999",
                          linestyle=":" if beyond else "-")
        for point, kind in zip(points, kinds):
            phantom = sharp and point[1] < 0
            x, y = lattice(*point)
            axes.plot(x, y, "o", markersize=9, color=colours[kind],
                      markerfacecolor="white" if phantom else colours[kind])
            if not sharp:
                axes.annotate(kind, (x, y), (0, 9), textcoords="offset points", ha="center", fontsize=8,
                              bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.6, "alpha": 0.8})
        if sharp:
            axes.plot(*np.array([lattice(-1, 0), lattice(2, 0)]).T, color="#b3261e", linewidth=2.2, zorder=0)
            for name, point, offset in [("x", (0, 0), (-11, 8)), ("y", (1, 0), (11, 8)), ("z", (0, 1), (0, 10)),
                                        ("x + y - z", (1, -1), (0, -17))]:
                axes.annotate(name, lattice(*point), offset, textcoords="offset points", ha="center", fontsize=9)
            axes.annotate("", lattice(1, -1), lattice(0, 1),
                          arrowprops={"arrowstyle": "->", "linestyle": "--", "color": "#b3261e", "shrinkA": 8,
                                      "shrinkB": 8})
        axes.set_title("the lower edge is sharp: hollow points are phantoms" if sharp else
                       "a regular triangle and its 12 points", fontsize=10)
        axes.set(xlim=(-1.35, 2.35), ylim=(-1.25, 2.1), aspect="equal")
        axes.set_axis_off()
    figure.tight_layout()
    figure.savefig(output, dpi=100)
    plt.close(figure)


def draw_three_passes(output):
    """A face and its neighbours at level 3: what fans, strips and patches make of it."""
    n = 8
    figure, panels = plt.subplots(1, 3, figsize=(10.5, 3.7))
    corners = [(0, 0), (n, 0), (0, n)]
    edges = [(k, 0) for k in range(1, n)] + [(n - k, k) for k in range(1, n)] + [(0, k) for k in range(1, n)]
    ring = [(1, 0), (0, 1), (-1, 1), (-1, 0), (0, -1), (1, -1)]
    fan = [(c[0] + d[0], c[1] + d[1]) for c in corners for d in ring]
    rows = [(k, 1) for k in range(n)] + [(k + 1, -1) for k in range(n)]
    face = [(i, j) for j in range(1, n) for i in range(1, n - j)]
    titles = ["fans: a vertex and its ring", "strips: an edge and the rows beside it", "patches: the inside of a face"]
    shown = [(corners, fan, []), (edges, rows, corners), (face, [], edges + corners)]
    for axes, title, (made, helped, given) in zip(panels, titles, shown):
        for a, b in [((0, 0), (n, 0)), ((n, 0), (0, n)), ((0, n), (0, 0))]:
            axes.plot(*np.array([lattice(*a), lattice(*b)]).T, color="#bbbbbb", linewidth=1, zorder=0)
        for points, colour, size in [(helped, "#9ec5e8", 13), (given, "#8d6e63", 20), (made, "#1f4e79", 20)]:
            if points:
                axes.scatter(*np.array([lattice(*p) for p in points]).T, s=size, color=colour, zorder=2)
        axes.set_title(title, fontsize=10)
        axes.set(xlim=(-1.8, n + 1.8), ylim=(-1.4, n * math.sqrt(3) / 2 + 1.4), aspect="equal")
        axes.set_axis_off()
    figure.tight_layout()
    figure.savefig(output, dpi=100)
    plt.close(figure)


def draw_descent(output):
    """A triangle with one irregular corner: what is regular at each level, and the way to a point near the corner."""
    a, b, c = np.array([0.0, 0.0]), np.array([1.0, 0.0]), np.array([0.0, 1.0])
    to_plane = np.array([[1.0, 0.0], [0.5, math.sqrt(3) / 2]])
    figure, axes = plt.subplots(figsize=(7.2, 5.0))
    colours = plt.get_cmap("Blues")(np.linspace(0.12, 0.75, 6))
    for level in range(1, 7):
        ab, bc, ca = (a + b) / 2, (b + c) / 2, (c + a) / 2
        for child, corners in enumerate([(a, ab, ca), (ab, b, bc), (ca, bc, c), (bc, ca, ab)]):
            if child == 0:
                continue
            polygon = np.array(corners) @ to_plane
            axes.fill(*polygon.T, facecolor=colours[level - 1], edgecolor="#333333", linewidth=0.8)
            if level <= 3:
                axes.text(*polygon.mean(axis=0), f"level {level}\nchild {child}" if level < 3 else str(child),
                          ha="center", va="center", fontsize=[10, 8, 7][level - 1])
        b, c = ab, ca
    axes.fill(*(np.array([a, b, c]) @ to_plane).T, facecolor="#b3261e", linewidth=0)
    axes.annotate("the irregular corner: never\nregular, but as small as you like", (0.008, 0.008), (-0.12, 0.64),
                  fontsize=9, arrowprops={"arrowstyle": "->", "linewidth": 0.8})
    point = np.array([0.07, 0.03]) @ to_plane
    axes.plot(*point, "o", color="black", markersize=4)
    axes.annotate("(u, v) = (0.07, 0.03):\nchild 0 three times, then child 1, regular", point, (0.12, -0.13),
                  fontsize=9, arrowprops={"arrowstyle": "->", "linewidth": 0.8}, annotation_clip=False)
    axes.set(xlim=(-0.14, 1.02), ylim=(-0.16, 0.9), aspect="equal")
    axes.set_axis_off()
    figure.tight_layout()
    figure.savefig(output, dpi=100)
    plt.close(figure)


def run_curve(loopcheck, points, *options):
    subprocess.run([loopcheck, "curve", str(points), *map(str, options)], check=True, stdout=subprocess.DEVNULL)


def write_points(path, points):
    pathlib.Path(path).write_text("".join(" ".join(map(repr, map(float, p))) + "\n" for p in points))
    return path


def curve_points(loopcheck, points, folder, *options, levels=6):
    """One array a level: columns t, x, y, z of the point and x, y, z of the curve at t; NaN outside the domain."""
    rows = pathlib.Path(folder) / "curve.csv"
    run_curve(loopcheck, points, "--levels", levels, "--csv", rows, *options)
    table = np.genfromtxt(rows, delimiter=",", skip_header=1)
    return [table[table[:, 0] == level][:, 2:9] for level in range(levels + 1)]


def draw_curve_pictures(loopcheck, curves, output):
    """What --svg writes."""
    lab, pulse = curves / "lab.txt", curves / "pulse.txt"
    run_curve(loopcheck, lab, "--levels", 3, "--svg", output / "curve-lab.svg")
    run_curve(loopcheck, lab, "--levels", 3, "--svg", output / "curve-lab-magnified.svg", "--magnify", 4)
    run_curve(loopcheck, curves / "ring.txt", "--closed", "--levels", 3, "--svg", output / "curve-ring.svg")
    for degree in (1, 2, 3):
        run_curve(loopcheck, pulse, "--ends", "open", "--degree", degree, "--levels", 3, "--svg",
                  output / f"curve-pulse-{degree}.svg")


def draw_basis(loopcheck, pulse, output, folder):
    """Each function is the mean of the one before over a window of length 1."""
    figure, panels = plt.subplots(1, 4, figsize=(11, 2.9), sharey=True)
    step = np.array([[-2.5, 0], [-0.5, 0], [-0.5, 1], [0.5, 1], [0.5, 0], [2.5, 0]])
    graphs = [step]
    for degree in (1, 2, 3):
        fine = curve_points(loopcheck, pulse, folder, "--ends", "open", "--degree", degree)[-1]
        graphs.append(fine[:, 4:6])
    window = [None, (0.2, 1.2), (0.35, 1.35), (0.5, 1.5)]  # where the mean of the graph before is shown
    for degree, (axes, graph) in enumerate(zip(panels, graphs)):
        axes.plot(*graph.T, color="#1f4e79", linewidth=2.2, zorder=3)
        if degree > 0:
            before = graphs[degree - 1]
            low, high = window[degree]
            axes.plot(*before.T, color="0.6", linewidth=1, zorder=1)
            if degree == 1:
                axes.fill_between([low, 0.5], 0, 1, color="#f0c36d", alpha=0.6, linewidth=0)
            else:
                x = np.linspace(low, high, 200)
                axes.fill_between(x, 0, np.interp(x, *before.T), color="#f0c36d", alpha=0.6, linewidth=0)
            middle = (low + high) / 2
            axes.plot(middle, np.interp(middle, *graph.T), "o", color="#b3261e", markersize=5.5, zorder=4)
            axes.plot([low, low, high, high], [-0.03, -0.06, -0.06, -0.03], color="#b3261e", linewidth=1)
        knots = np.arange(-(degree + 1) / 2, (degree + 1) / 2 + 0.5)
        axes.plot(knots, np.zeros_like(knots), "|", color="#1f4e79", markersize=9, zorder=4)
        axes.set(xlim=(-2.4, 2.4), ylim=(-0.1, 1.08), xticks=range(-2, 3),
                 title=["degree 0: the box", "degree 1: the hat", "degree 2", "degree 3: the cubic"][degree])
        axes.title.set_fontsize(10)
        axes.tick_params(labelsize=8)
        axes.grid(alpha=0.25)
    figure.tight_layout()
    figure.savefig(output, dpi=100)
    plt.close(figure)


def draw_curve_errors(loopcheck, curves, output, folder):
    """The distance of the polygon from the curve at every level, and the bound."""
    figure, axes = plt.subplots(figsize=(7.4, 4.1))
    report = pathlib.Path(folder) / "curve.json"
    cases = [("wandering.txt", "natural", 5, "#7a7a7a", "D"), ("lab.txt", "natural", 3, "#1f4e79", "o"),
             ("lab.txt", "clamped", 3, "#b3261e", "s"), ("ring.txt", "closed", 2, "#2e7d32", "^")]
    for name, ends, degree, colour, marker in cases:
        run_curve(loopcheck, curves / name, "--ends", ends, "--degree", degree, "--levels", 8, "--json", report)
        levels = json.loads(report.read_text())["curve"]["levels"]
        axes.semilogy([one["level"] for one in levels], [one["distance"] for one in levels], marker + "-", color=colour,
                      markersize=5.5, label=f"{name[:-4]}, degree {degree}, {ends}")
        if levels[0]["allowed"] is not None:
            axes.semilogy([one["level"] for one in levels], [one["allowed"] for one in levels], "--", color=colour,
                          linewidth=1, alpha=0.7)
    axes.semilogy([5, 6, 6], [2.4e-3, 2.4e-3, 6e-4], color="black", linewidth=0.9)
    axes.semilogy([5, 6], [2.4e-3, 6e-4], color="black", linewidth=0.9)
    axes.annotate("4", (6, 1.2e-3), (6, 0), textcoords="offset points", va="center", fontsize=10)
    axes.plot([], [], "--", color="0.4", linewidth=1,
              label="the bound; without clamped ends cubics\nand quadratics reach it")
    axes.set(xlabel="level", ylabel="largest distance from the curve", xticks=range(9))
    axes.grid(alpha=0.25)
    axes.legend(fontsize=8, loc="lower left")
    figure.tight_layout()
    figure.savefig(output, dpi=100)
    plt.close(figure)


def draw_phantoms(loopcheck, axes, control, folder):
    """The phantom of an end, one level on, and the curve that both give."""
    levels = curve_points(loopcheck, write_points(pathlib.Path(folder) / "end.txt", control), folder)
    coarse, fine, curve = levels[0][:, 1:3], levels[1][:, 1:3], levels[-1][:, 4:6]
    axes.plot(*curve.T, color="#222222", linewidth=2.2, zorder=2)
    for points, colour, size in ((coarse, "#1f4e79", 8), (fine, "#e08a00", 6)):
        phantom = 2 * points[0] - points[1]
        axes.plot(*points.T, "o-", color=colour, markersize=size, linewidth=1.1, zorder=3)
        axes.plot(*np.array([phantom, points[0]]).T, linestyle=":", color=colour, linewidth=1.4, zorder=1)
        axes.plot(*phantom, "o", color=colour, markerfacecolor="white", markersize=size, zorder=4)
    for text, point, offset, colour in [
            ("c_0 = c'_0", coarse[0], (12, -3), "#1f4e79"), ("c_1", coarse[1], (0, 9), "#1f4e79"),
            ("c_2", coarse[2], (9, -3), "#1f4e79"), ("2 c_0 - c_1", 2 * coarse[0] - coarse[1], (12, -3), "#1f4e79"),
            ("2 c'_0 - c'_1", 2 * fine[0] - fine[1], (12, -3), "#e08a00"), ("c'_1", fine[1], (-22, 4), "#e08a00"),
            ("c'_2", fine[2], (0, -17), "#e08a00")]:
        axes.annotate(text, point, offset, textcoords="offset points", fontsize=9.5, color=colour,
                      ha="left" if offset[0] else "center")
    axes.set_title("a phantom, and the phantom of the next level", fontsize=10)


def draw_ends(loopcheck, axes, control, folder):
    """Four ways to end a sum, by control points that the curve without end rules is given."""
    path = pathlib.Path(folder) / "end.txt"

    def open_curve(points):
        rows = curve_points(loopcheck, write_points(path, points), folder, "--ends", "open")[-1][:, 4:7]
        return rows[~np.isnan(rows[:, 0])]

    homogeneous = [[x, y, 1] for x, y in control]
    plain = open_curve([[0, 0, 0], *homogeneous, [0, 0, 0]])  # z is the sum of the basis
    doubled = open_curve([homogeneous[0], *homogeneous, homogeneous[-1]])
    natural = curve_points(loopcheck, write_points(path, control), folder)[-1][:, 4:6]
    axes.plot(*np.array(control).T, "o--", color="#999999", linewidth=1, markersize=4)
    axes.plot(*natural.T, color="#c9c9c9", linewidth=6, solid_capstyle="butt",
              label="natural: the limit of subdivision")
    for curve, colour, label in [(plain, "#b3261e", "plain sum"), (doubled, "#7b5ea7", "end points doubled"),
                                 (plain[:, :2] / plain[:, 2:], "#2e7d32", "plain sum over the sum of the basis")]:
        axes.plot(*curve[:, :2].T, color=colour, linewidth=1.5, label=label)
        axes.plot(*curve[0, :2], "o", color=colour, markersize=6)
    axes.set(xlim=(-0.825, -0.5), ylim=(0.735, 1.02))
    axes.legend(fontsize=8.5, loc="upper right", title="a dot is the point of t = 0", title_fontsize=8.5)
    axes.set_title("the first end of lab.txt, four ways", fontsize=10)


def draw_curve_ends(loopcheck, lab, output, folder):
    figure, (left, right) = plt.subplots(1, 2, figsize=(10.4, 4.2))
    draw_phantoms(loopcheck, left, [(0, 0), (1.2, 1.3), (2.9, 1.0), (3.6, -0.4)], folder)
    draw_ends(loopcheck, right, np.loadtxt(lab).tolist(), folder)
    for axes in (left, right):
        axes.set_aspect("equal")
        axes.set_axis_off()
    left.margins(0.1)
    figure.tight_layout()
    figure.savefig(output, dpi=100)
    plt.close(figure)


def main():
    loopcheck, models, output = sys.argv[1:]
    curves, output = pathlib.Path(models) / "curves", pathlib.Path(output)
    cow = str(pathlib.Path(models) / "cow.obj")
    with tempfile.TemporaryDirectory() as folder:
        draw_levels(loopcheck, cow, output / "cow-levels.png", folder)
        draw_lab_figures(loopcheck, cow, output / "adaptive-lab.png", folder)
        draw_three_ways(loopcheck, cow, output / "adaptive-three-ways.png", folder)
        draw_deviations(loopcheck, output, folder)
        draw_characteristic_maps(loopcheck, output / "characteristic-maps.png", folder)
        draw_basis(loopcheck, curves / "pulse.txt", output / "curve-basis.png", folder)
        draw_curve_errors(loopcheck, curves, output / "curve-errors.png", folder)
        draw_curve_ends(loopcheck, curves / "lab.txt", output / "curve-ends.png", folder)
    draw_patterns(output / "adaptive-patterns.png")
    draw_curve_pictures(loopcheck, curves, output)
    draw_eigenvalues(output / "eigenvalues.png")
    draw_twelve_points(output / "twelve-points.png")
    draw_descent(output / "descent.png")
    draw_three_passes(output / "three-passes.png")


if __name__ == "__main__":
    main()
