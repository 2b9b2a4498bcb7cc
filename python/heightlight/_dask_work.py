"""A bake by windows on the workers of a cluster: the part of each process, and the placing of tasks."""

from __future__ import annotations

import hashlib
import json
import threading
import time
from dataclasses import dataclass, field, replace
from typing import Any, Callable, Optional

try:
    import dask
    import dask.array
    import distributed
except ImportError as missing:
    raise ImportError("heightlight.dask wants Dask's distributed scheduler: Debian's python3-distributed and python3-dask") from missing
import numpy as np

from . import _native
from ._heights import numbers
from ._settings import settings

Tell = Optional[Callable[[str, int, int, bool], object]]

# Retries of a task that fails, for example because a file system is unavailable for a moment. Dask itself repeats the
# tasks of a lost worker.
_RETRIES = 2

# Seconds that a worker waits for a file that another machine has written to become visible.
_PATIENCE = 10.0

# Fraction of a worker's memory limit that is used: Dask pauses workers that hold more.
_MEMORY_SHARE = 0.8

# A worker does one window at a time, with all its threads, so that it needs the memory of one window.
worker_lock = threading.Lock()
_shares: dict[str, Any] = {}  # what this process holds of each current bake, by mark


@dataclass(frozen=True)
class Task:
    """Describes a bake. Every process makes its `_native.Work` from it."""

    mark: str  # identifies one call of `bake`
    maps: list[str]
    choice: dict[str, Any]
    accuracy: dict[str, Any]
    threads: Optional[int]  # per worker; None: as many as Dask gave the worker
    memory: Optional[int]  # bytes per worker
    place: dict[str, Any] = field(default_factory=dict)

    def share(self, threads: Optional[int] = None) -> Any:
        """This process's handle on the work, with that many threads unless the task says otherwise."""
        chosen = settings(**self.accuracy, threads=self.threads or threads, memory=self.memory)
        return _native.Work(chosen, self.maps, self.choice, self.place)

    def of_heights(self, checksum: str) -> Task:
        """The same task once its heights are known: it gets checksums of everything that results and files depend on."""
        surface = [_native.version, checksum, self.place["load"]]
        request = [*surface, self.maps, self.choice, self.accuracy, *(self.place[key] for key in ("format", "depth", "side"))]
        return replace(self, place={**self.place, "surface": _checksum(surface), "request": _checksum(request)})


def _checksum(told: Any) -> str:
    return hashlib.sha256(json.dumps(told).encode()).hexdigest()


def own_threads() -> int:
    """Number of threads of the worker that this runs on."""
    return distributed.get_worker().state.nthreads


def _joined(task: Task, stage: str) -> Any:
    """This process's handle on the work, brought to that stage."""
    share = _shares.get(task.mark)
    if share is not None and share.stage == stage:
        return share
    if share is None:
        share = task.share(own_threads())
    share.join()
    deadline = time.monotonic() + _PATIENCE
    while share.stage != stage:
        if time.monotonic() > deadline:
            raise OSError(f"{task.place['folder']}: is at '{share.stage}' here, and elsewhere at '{stage}'; do all workers share it?")
        time.sleep(0.1)
        share.join()
    _shares[task.mark] = share
    return share


def _run_part(part: int, task: Task, stage: str) -> None:
    with worker_lock:
        _joined(task, stage).run(part)


def _begin(task: Task) -> Task:
    """Begins the bake of a map's file. One worker reads it, row by row, and writes the files of the windows."""
    with worker_lock:
        known = task.of_heights(_native.sha256_of_file(task.place["map"]))
        known.share(own_threads()).open()
        return known


def _finish(task: Task, output: str, name: str) -> tuple[list[str], list[str]]:
    with worker_lock:
        return _joined(task, "done").finish(output, name, task.place["map"])


def _give_block(folder: str, window: int, block: Any, missing: Any) -> tuple[tuple[float, float, int], str]:
    """Stores a block of heights for the work. Returns facts about the block, and its checksum."""
    heights = np.array(numbers("height", block), dtype=np.float64, order="C")
    if missing is not None:
        heights[heights == missing] = np.nan
    return _native.give_block(folder, window, heights), hashlib.sha256(heights.tobytes()).hexdigest()


def _forget(mark: str) -> None:
    _shares.pop(mark, None)


def results_of(client: Any, futures: list[Any], step: str, tell: Tell) -> list[Any]:
    """The results of tasks, in the order of the tasks. If one fails, or this is interrupted, the others are cancelled."""
    order = {future.key: i for i, future in enumerate(futures)}
    results: list[Any] = [None] * len(futures)
    waiting = distributed.as_completed(futures)
    futures.clear()  # finished futures are released, so that a lost worker cannot lose their results
    done = 0
    try:
        for future in waiting:
            results[order[future.key]] = future.result()
            done += 1
            if tell:
                tell(step, done, len(order), done == len(order))
    except BaseException:
        client.cancel(list(waiting.futures))
        raise
    return results


def worker_memory(client: Any) -> Optional[int]:
    """Bytes that every worker may take; None if the workers have no limit."""
    limits = [worker["memory_limit"] for worker in client.scheduler_info()["workers"].values() if worker["memory_limit"]]
    return int(min(limits) * _MEMORY_SHARE) if limits else None


def _check_memory(share: Any, memory: Optional[int]) -> None:
    if memory is not None and share.bytes > memory:
        window, needed, there = share.facts["window"], share.bytes >> 20, memory >> 20
        raise MemoryError(f"windows of {window} × {window} texels need {needed} MiB, and a worker has {there} MiB; choose a smaller window, or give memory")


def open_file(client: Any, task: Task) -> Task:
    """Begins the bake of a map's file, or continues an earlier one."""
    return results_of(client, [client.submit(_begin, task, pure=False)], "heights", None)[0]


def open_array(client: Any, task: Task, array: Any, texel: tuple[float, float], boundary: str, tell: Tell = None) -> Task:
    """As open_file, for heights in a Dask array with row 0 on top; tasks write its chunks to the work folder. `array` is
    (the array, the value of a missing sample or None)."""
    data, missing = array
    side = task.place["side"]
    give = dask.delayed(_give_block, pure=False)
    tasks = [give(task.place["folder"], i, block, missing) for i, block in enumerate(data.rechunk((side, side)).to_delayed().ravel())]
    told = results_of(client, client.compute(tasks, retries=_RETRIES), "blocks", tell)
    known = task.of_heights(_checksum([data.shape, texel, boundary, side, [checksum for _, checksum in told]]))
    known.share().open_given({"shape": data.shape, "texel": texel, "boundary": boundary, "blocks": [facts for facts, _ in told]})
    return known


def do_steps(client: Any, task: Task, tell: Tell) -> Any:
    """Does all steps of a bake that has begun. Returns this process's handle on the work."""
    share = task.share()
    share.join()
    _check_memory(share, task.memory)
    while share.stage != "done":
        stage = share.stage
        parts = share.pending()
        placed = client.map(_run_part, parts, task=task, stage=stage, pure=False, retries=_RETRIES, key=f"heightlight {stage}")
        results_of(client, placed, stage, tell)
        share.advance()
    return share


def write_files(client: Any, task: Task, output: str, name: str) -> tuple[list[str], list[str]]:
    """Lets a worker write the files of a finished bake. Returns their names, and the warnings."""
    return results_of(client, [client.submit(_finish, task, output, name, pure=False)], "files", None)[0]


def forget(client: Any, task: Task) -> None:
    """Makes the workers release what they hold of the task."""
    client.run(_forget, task.mark, on_error="ignore")
