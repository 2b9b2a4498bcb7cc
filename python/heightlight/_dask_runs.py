"""Runs of a dataset on a worker, by the program `heightlight`."""

from __future__ import annotations

import shutil
import subprocess
from typing import Optional

from ._dask_work import own_threads, worker_lock

# Exit codes of the program: everything done, or everything except the plots.
_DONE = (0, 3)
_WRONG_USAGE = 2


def run_program(program: Optional[str], where: tuple[str, str], *arguments: str) -> None:
    """Runs `heightlight dataset`. `where` is (manifest, folder). Raises ValueError and OSError with the message that
    the program prints."""
    found = program or shutil.which("heightlight")
    if found is None:
        raise FileNotFoundError("heightlight: no such program on PATH here; install it, or say where it is (command)")
    manifest, folder = where
    ended = subprocess.run(
        [found, "dataset", manifest, "-o", folder, "--quiet", *arguments], stdin=subprocess.DEVNULL, capture_output=True, text=True
    )
    if ended.returncode in _DONE:
        return
    said = ended.stderr.strip() or f"{found}: ended with {ended.returncode}"
    raise ValueError(said) if ended.returncode == _WRONG_USAGE else OSError(said)


def run_shard(shard: int, count: int, where: tuple[str, str], limits: tuple[Optional[int], Optional[int]], program: Optional[str]) -> None:
    """Runs shard number `shard` of `count`. `limits` is (threads, memory in bytes)."""
    threads, memory = limits
    arguments = ["--shard", f"{shard}/{count}", "--threads", str(threads or own_threads())]
    if memory is not None:
        arguments += ["--memory", str(memory)]
    with worker_lock:
        run_program(program, where, *arguments)
