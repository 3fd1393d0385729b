"""Runs the commands shown in the documentation and compares what they print with what is shown.

A command is an indented line that begins with "$ "; what it prints is the indented lines that follow.  Links to files of
this repository must lead somewhere.

usage: docs_test.py LOOPCHECK SOURCE_DIR
"""

import pathlib
import re
import subprocess
import sys

INDENT = "    "


def examples(text):
    """Pairs of a command and its output."""
    found, current = [], None
    for line in text.splitlines() + ["end"]:
        if line.startswith(INDENT + "$ "):
            current = (line[len(INDENT) + 2:], [])
            found.append(current)
        elif line.startswith(INDENT) or not line:
            if current:
                current[1].append(line[len(INDENT):])
        else:
            current = None
    return [(command, "\n".join(output).strip("\n")) for command, output in found]


def printed(command, loopcheck, source):
    program, rest = command.split(" ", 1)
    assert program in ("loopcheck", "build/release/loopcheck"), command
    shell = subprocess.run(f"{loopcheck} {rest}", shell=True, cwd=source, text=True, stdout=subprocess.PIPE,
                           stderr=subprocess.STDOUT, check=False)
    return "\n".join(line.rstrip() for line in shell.stdout.splitlines()).strip("\n")


def main():
    loopcheck, source = sys.argv[1], pathlib.Path(sys.argv[2])
    failures = checked = 0
    for page in sorted([*source.glob("*.md"), *source.glob("docs/**/*.md")]):
        text = page.read_text()
        for command, shown in examples(text):
            checked += 1
            actual = printed(command, loopcheck, source)
            if actual != shown:
                failures += 1
                print(f"{page}: $ {command}\n--- shown\n{shown}\n--- printed\n{actual}")
        for target in re.findall(r"\]\(([^)#]+)\)", text):
            if "://" not in target and not (page.parent / target).exists():
                failures += 1
                print(f"{page}: the link to {target} leads nowhere")
    print(f"{checked} commands, {failures} failures")
    sys.exit(failures > 0 or checked == 0)


if __name__ == "__main__":
    main()
