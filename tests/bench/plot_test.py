"""bench/plot.py draws a line for every subject of every task in every precision, and names it.

usage: plot_test.py PLOT JSON SVG
"""

import json
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

SVG = "{http://www.w3.org/2000/svg}"

plot, source, target = sys.argv[1:]
subprocess.run([sys.executable, "-B", plot, source, target], check=True)
with open(source, encoding="utf-8") as file:
    cases = json.load(file)["cases"]
lines = {(c["task"], c["precision"], s["name"], s["threads"]) for c in cases for s in c["subjects"] if "ns" in s}
writes = {(c["task"], c["precision"], threads) for c in cases for threads, _ in enumerate(c["write_ns"])}
root = ElementTree.parse(target).getroot()
drawn = [line.get("points").split() for line in root.iter(f"{SVG}polyline")]
assert len(drawn) == len(lines) + len(writes) > 2, (len(drawn), len(lines), len(writes))
assert len(list(root.iter(f"{SVG}circle"))) == sum(len(points) for points in drawn)
texts = {text.text for text in root.iter(f"{SVG}text")}
assert {name for _, _, name, _ in lines} <= texts, texts
