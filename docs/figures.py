"""Draws the figures of README.md and docs/ from what loopcheck writes.  Run by scripts/figures.

usage: figures.py LOOPCHECK MODELS OUTPUT
"""

import csv
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
from matplotlib.colors import LogNorm  # noqa: E402
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


def draw_levels(loopcheck, model, output, folder):
    """The control mesh and three levels, side by side."""
    figure = plt.figure(figsize=(13, 3.1))
    for level in range(4):
        path = pathlib.Path(folder) / f"{level}.obj"
        subprocess.run([loopcheck, "refine", model, "-o", path, "--levels", str(level)], check=True,
                       stdout=subprocess.DEVNULL)
        vertices, faces = read_obj(path)
        axes = figure.add_subplot(1, 4, level + 1, projection="3d")
        draw(axes, vertices, faces, (0.86, 0.80, 0.72), edges=level < 2, zoom=1.3)
        name = "control mesh" if level == 0 else f"level {level}"
        axes.set_title(f"{name}: {len(faces)} faces", fontsize=9, y=-0.02)
    figure.subplots_adjust(0, 0.04, 1, 1, 0, 0)
    figure.savefig(output, dpi=110)


def draw_difference(loopcheck, model, output, folder):
    """Where Warren's weights differ from Loop's, at level 3, on a log scale."""
    mesh, rows = pathlib.Path(folder) / "w.obj", pathlib.Path(folder) / "w.csv"
    subprocess.run([loopcheck, "refine", model, "-o", mesh, "--levels", "3"], check=True, stdout=subprocess.DEVNULL)
    subprocess.run([loopcheck, "compare", model, "--weights", "warren", "--levels", "3", "--csv", rows],
                   stdout=subprocess.DEVNULL, check=False)  # exits with 1: they differ
    vertices, faces = read_obj(mesh)
    with open(rows, newline="") as file:
        error = np.array([float(row["error"]) for row in csv.DictReader(file) if row["level"] == "3"])
    norm = LogNorm(1e-5, 2e-2)
    face_error = np.clip(error[faces].max(axis=1), norm.vmin, norm.vmax)
    figure = plt.figure(figsize=(7, 3.9))
    axes = figure.add_axes([0, 0, 0.82, 1], projection="3d")
    draw(axes, vertices, faces, plt.get_cmap("cividis")(norm(face_error)), edges=False, zoom=1.36)
    bar = figure.colorbar(plt.cm.ScalarMappable(norm, "cividis"), cax=figure.add_axes([0.84, 0.12, 0.025, 0.76]))
    bar.set_label("largest |difference| of a face's vertices, model units", fontsize=8)
    figure.savefig(output, dpi=110)


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


def main():
    loopcheck, models, output = sys.argv[1:]
    cow = str(pathlib.Path(models) / "cow.obj")
    with tempfile.TemporaryDirectory() as folder:
        draw_levels(loopcheck, cow, pathlib.Path(output) / "cow-levels.png", folder)
        draw_deviations(loopcheck, pathlib.Path(output), folder)
        draw_difference(loopcheck, cow, pathlib.Path(output) / "cow-warren.png", folder)


if __name__ == "__main__":
    main()
