#!/usr/bin/env python3
"""Peak of the process over what --memory promises: `bake` and `simulate` on brick and fBm of several sizes.

A cell is the peak over the promise, in percent; "→ 371M: 88" where the promise was refused, with what the
refusal named, and the peak over that. Ends with 1 where a promise was broken, or a refusal named nothing.

    bench/memory_bench.py build/heightlight
"""

import argparse
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

MEBI = 1 << 20
UNITS = {"M": MEBI, "G": 1 << 30}
COMMANDS = {
    "bake": ["bake"],
    "bake all": ["bake", "--maps", "ao,ao-n,bent-normal,horizon,multibounce,normal,sh"],
    "simulate": ["simulate"],
}


def run(program: Path, words: list[str], folder: Path) -> tuple[int, int, str]:
    """Exit code, peak in bytes, and what was said."""
    with open(folder / "said", "wb") as said:
        process = subprocess.Popen([program, *words], cwd=folder, stderr=said, stdout=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    text = (folder / "said").read_text()
    return process.returncode, usage.ru_maxrss * 1024, text


def measure(program: Path, words: list[str], memory: str, folder: Path) -> tuple[str, float]:
    """A cell, and the peak over the promise that was kept or broken."""
    code, peak, said = run(program, [*words, "--memory", memory], folder)
    cell = ""
    if code == 1 and (named := re.search(r"\(--memory (\d+M)\)", said)):
        memory = named[1]
        cell = f"→ {memory}: "
        code, peak, said = run(program, [*words, "--memory", memory], folder)
    if code != 0:
        return f"exit {code}: {said.strip()}", float("inf")
    share = peak / (int(memory[:-1]) * UNITS[memory[-1]])
    return cell + f"{100 * share:.0f}", share


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("--sizes", default="512,1024,2048,4096")
    parser.add_argument("--memory", default="200M,300M,500M,1G,2G,4G,8G")
    parser.add_argument("--shapes", default="brick,fbm")
    parser.add_argument("--commands", default=",".join(COMMANDS), help="of them (%(default)s)")
    parser.add_argument("--threads", default="2")
    options = parser.parse_args()
    amounts = options.memory.split(",")
    worst = 0.0
    print("| | " + " | ".join(amounts) + " |")
    print("|---" * (len(amounts) + 1) + "|")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for shape in options.shapes.split(","):
            for size in options.sizes.split(","):
                synth = ["synth", shape, "--size", size, "-o", "map.png"]
                subprocess.run([options.program.resolve(), *synth], cwd=folder, check=True)
                for title in options.commands.split(","):
                    words = COMMANDS[title]
                    line = [words[0], "map.png", "-o", "out", "--threads", options.threads, "--quiet", *words[1:]]
                    cells = [measure(options.program.resolve(), line, memory, folder) for memory in amounts]
                    worst = max([worst, *(share for _, share in cells)])
                    print(f"| {shape} {size}², {title} | " + " | ".join(text for text, _ in cells) + " |", flush=True)
    print(f"\nworst: {100 * worst:.0f} %")
    return 0 if worst <= 1 else 1


if __name__ == "__main__":
    sys.exit(main())
