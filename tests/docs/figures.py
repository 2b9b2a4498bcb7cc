"""Figures that pages quote are still in the data that they were taken from.

    figures.py ROOT     checks README.md and docs/*.md of the repository at ROOT

A page marks them:

    <!-- figures: plots/data/models.csv, plots/data/models_alone.csv -->
    … RMS of .0198 at albedo .5, 47 % of it …
    <!-- /figures -->

In between, every number with a decimal point and every percentage must be that of some number in the files named, rounded
to as many decimals; of a percentage, the number or a hundred times it. Signs do not count: pages have several ways to write
them. Code does not count either, in a line or in blocks.
"""

import re
import sys
from bisect import bisect_left
from pathlib import Path
from typing import NamedTuple

MARK = re.compile(r"<!--\s*(?:figures:\s*(?P<files>.*?)|(?P<end>/figures))\s*-->")
CODE = re.compile(r"`[^`]*`")
FENCE = re.compile(r"\s*(```|~~~)")
SUPERSCRIPTS = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")
FIGURE = re.compile(
    r"(?<![\w.])(?P<digits>\d*\.\d+|\d+(?=\s*%))"
    r"(?:[eE](?P<power>[-+]?\d+)|\s*[·×]\s*10(?P<raised>[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+))?"
    r"(?P<percent>\s*%)?(?![\w]|\.\d)"
)
NUMBER = re.compile(r"(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")


class Figure(NamedTuple):
    """A number as a page has it."""

    text: str
    value: float
    half_unit: float  # half of the last digit's worth
    is_percentage: bool


def find_figures(line):
    """The figures of a line of prose."""
    for match in FIGURE.finditer(line):
        power = int(match["power"] or (match["raised"] or "0").translate(SUPERSCRIPTS))
        decimals = len(match["digits"].partition(".")[2])
        yield Figure(
            text=match[0].strip(),
            value=float(match["digits"]) * 10.0**power,
            half_unit=0.5 * 10.0 ** (power - decimals),
            is_percentage=match["percent"] is not None,
        )


def read_numbers(path):
    """All numbers of a file, without their signs, from the least on."""
    return sorted({float(number) for number in NUMBER.findall(path.read_text(encoding="utf-8"))})


def is_rounded_from(numbers, value, half_unit):
    """Whether one of the sorted numbers is within half a unit of the value."""
    slack = half_unit * (1 + 1e-9)
    at = bisect_left(numbers, value - slack)
    return at < len(numbers) and numbers[at] <= value + slack


def is_there(figure, numbers):
    """Whether the figure is one of the numbers, as the page rounds it."""
    if is_rounded_from(numbers, figure.value, figure.half_unit):
        return True
    return figure.is_percentage and is_rounded_from(numbers, figure.value / 100, figure.half_unit / 100)


class Page:
    """Reads a page line by line, and keeps what is wrong with it."""

    def __init__(self, root, path):
        self.root = root
        self.name = path.relative_to(root).as_posix()
        self.faults = []
        self.figures = 0
        self.opened = None  # the line of the mark
        self.files = ""
        self.numbers = []
        self.is_code = False
        for line_number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), start=1):
            self.read(line_number, line)
        if self.opened is not None:
            self.fault(self.opened, "its figures have no end: <!-- /figures --> is missing")

    def fault(self, line_number, what):
        self.faults.append(f"{self.name}:{line_number}: {what}")

    def read(self, line_number, line):
        if FENCE.match(line):
            self.is_code = not self.is_code
            return
        if self.is_code:
            return
        line = CODE.sub("", line)
        at = 0
        for mark in MARK.finditer(line):
            self.check(line_number, line[at : mark.start()])
            self.read_mark(line_number, mark)
            at = mark.end()
        self.check(line_number, line[at:])

    def read_mark(self, line_number, mark):
        if (mark["end"] is not None) == (self.opened is None):
            self.fault(line_number, "figures end that did not begin" if mark["end"] else "figures begin within figures")
        if mark["end"]:
            self.opened = None
            return
        self.opened, self.files, numbers = line_number, mark["files"], set()
        for name in mark["files"].split(","):
            try:
                numbers.update(read_numbers(self.root / name.strip()))
            except (OSError, UnicodeDecodeError):
                self.fault(line_number, f"{name.strip() or 'no file'}: cannot be read as text")
        self.numbers = sorted(numbers)

    def check(self, line_number, prose):
        if self.opened is None:
            return
        for figure in find_figures(prose):
            self.figures += 1
            if not is_there(figure, self.numbers):
                self.fault(line_number, f"{figure.text} is not in {self.files}")


def check_pages(root):
    """What is wrong with the pages, and how many figures they mark."""
    pages = [Page(root, path) for path in [root / "README.md", *sorted((root / "docs").glob("*.md"))]]
    return [fault for page in pages for fault in page.faults], sum(page.figures for page in pages)


if __name__ == "__main__":
    found, count = check_pages(Path(sys.argv[1]).resolve())
    print(*found, f"{count} figures, {len(found)} faults", sep="\n")
    sys.exit(1 if found else 0)
