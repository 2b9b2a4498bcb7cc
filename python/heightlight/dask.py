"""Bakes and datasets on a Dask cluster.

    from dask.distributed import Client
    import heightlight as hl

    client = Client("scheduler:8786")
    maps = hl.dask.bake("alps.tif", client, maps=("ao", "bent-normal"))   # an xarray.Dataset, read when it is asked for
    tables = hl.dask.dataset("study.json", client, "study")

This module only places windows and runs on workers: what they find is what one process finds, to the last bit,
however many there are and whichever are lost. Workers and the client share one file system, where all of it lies,
and the package is installed on each of them.
"""

from __future__ import annotations

import os
import uuid
import warnings
from pathlib import Path
from typing import Any, Iterable, Optional, Union

from . import _native
from ._baking import bake_choice, map_names
from ._dask_work import Task, do_steps, forget, open_array, open_file, results_of, worker_memory, write_files
from ._dask_runs import run_program, run_shard
from ._heights import load_options, spacing
from ._settings import integer, one_of, progress_of, real

try:
    import dask.array
    import xarray as xr
except ImportError as missing:
    raise ImportError("heightlight.dask gives maps as xarray's: Debian's python3-xarray") from missing

from ._dask_maps import dataset_of

__all__ = ["bake", "dataset"]


def bake(
    source: Any,
    client: Any,
    *,
    maps: Union[str, Iterable[str]] = ("ao",),
    window: int = 4096,
    output: Union[str, os.PathLike, None] = None,
    folder: Union[str, os.PathLike, None] = None,
    name: Optional[str] = None,
    format: Optional[str] = None,
    depth: Union[int, str, None] = None,
    texel: Any = None,
    boundary: Optional[str] = None,
    albedo: Any = 0.5,
    error: float = 2e-3,
    azimuths: Optional[int] = None,
    max_distance: Optional[float] = None,
    falloff: str = "none",
    uniform_ao: bool = False,
    y_down: bool = False,
    horizon_azimuths: int = 4,
    azimuth_convention: Optional[str] = None,
    below_horizontal: str = "sky",
    seed: int = 1,
    threads: Optional[int] = None,
    memory: Optional[int] = None,
    progress: Any = False,
    **reading: Any,
) -> Any:
    """Maps of a material, as `heightlight.bake` makes them, window by window on the workers of a cluster.

    `source`: the path of a heightmap, which other arguments of `heightlight.read` may go with; or an xarray.DataArray
    with the coordinates that its accessor `heightlight` understands. Chunks of Dask come to the workers that they are
    for, and never together into one process. `client`: a distributed.Client.

    Returned is an xarray.Dataset, a variable per map, with the source's coordinates (of a file that has no place, world
    units from its lower left corner), and for maps of several channels a dimension NAME-channel; its attribute
    `evidence` is Bake's, as JSON. Its chunks are the windows; they are read from the work folder when they are asked for, so that the folder must stay as long as the dataset is used.
    With `output`, a folder, the maps are written there instead, as `heightlight bake` writes them: GeoTIFFs of terrain,
    PNGs of materials, or in `format` and `depth` as Bake.save has them, and NAME_bake.json. Then their paths are
    returned, and the work folder goes away.

    `window`: texels of a window's side, a multiple of 64. Results do not depend on it. `folder`: the work folder,
    NAME.windows where the client runs unless said otherwise (in `output` .NAME.windows), on a file system that the client
    and all workers share. The same call goes on with what an earlier one left there, another one begins it anew: datasets
    that are to be read beside each other need folders of their own. `threads`, `memory`: of each worker;
    those that Dask gave it.

    A total that is found to miss `error` is found once more, as `heightlight.bake` does it. What windows cannot do is a
    ValueError: "ao-n", the definitions of terrain science, an albedo that varies, "multibounce" beside a max_distance or under a
    sky that ends at the horizontal, maps that tile whose sides are no multiples of 8 (64, where they are very large).
    """
    array = source if isinstance(source, xr.DataArray) else None
    path = "" if array is not None else os.path.abspath(os.fspath(source))
    called = str(name or (array.name if array is not None else Path(path).stem) or "height")
    if os.sep in called:
        raise ValueError(f"name {called!r}: must be what files' names begin with")
    load: dict[str, Any] = {}
    if array is None:
        load = load_options(texel=texel, boundary=boundary, **reading)
    elif reading:
        raise ValueError(f"{', '.join(reading)}: of files, and not of arrays")
    if format is None:
        format = "tif" if array is not None or _native.is_terrain(path, load) else "png"
    task = Task(
        mark=uuid.uuid4().hex,
        maps=map_names(maps),
        choice=bake_choice(
            albedo,
            max_distance=max_distance,
            falloff=falloff,
            uniform_ao=uniform_ao,
            y_down=y_down,
            horizon_azimuths=horizon_azimuths,
            azimuth_convention=azimuth_convention,
            below_horizontal=below_horizontal,
        ),
        accuracy={
            "error": real("error", error),
            "azimuths": None if azimuths is None else integer("azimuths", azimuths),
            "seed": integer("seed", seed, 0, 2**64 - 1),
        },
        threads=threads,
        memory=worker_memory(client) if memory is None else memory,
        place={
            "map": path,
            "load": load,
            "side": integer("window", window, 64),
            "folder": _work_folder(folder, output, called),
            "request": "",
            "surface": "",
            "format": "exr" if output is None else format,  # of no file: each map with all its channels
            "depth": "" if depth is None or output is None else str(depth),
        },
    )
    task.share()  # says what cannot be done
    tell = progress_of(progress)
    try:
        task = open_file(client, task) if array is None else _open_array(client, task, array, texel, boundary, tell)
        share = do_steps(client, task, tell)
        if output is None:
            result = dataset_of(task, share, array, texel)
            told = share.warnings
        else:
            files, told = write_files(client, task, os.path.abspath(output), called)
            result = [Path(output, file) for file in files]
    finally:
        forget(client, task)
    for warning in told:
        warnings.warn(f"{path or called}: {warning}", stacklevel=2)
    return result


def _work_folder(folder: Any, output: Any, name: str) -> str:
    if folder is not None:
        return os.path.abspath(folder)
    return os.path.abspath(f"{name}.windows" if output is None else os.path.join(output, f".{name}.windows"))


def _open_array(client: Any, task: Task, array: Any, texel: Any, boundary: Optional[str], tell: Any) -> Task:
    """Of heights as xarray has them."""
    accessor = array.heightlight
    accessor._check_dimensions()
    x, y = accessor._steps(texel)
    steps = (abs(x), abs(y)) if texel is None else spacing(texel, array)
    held = array.data if dask.is_dask_collection(array.data) else dask.array.from_array(array.values, chunks=task.place["side"])
    heights = (accessor._turn(held, texel), accessor._missing())
    return open_array(client, task, heights, steps, one_of("boundary", boundary or "open", ("open", "tile")), tell)


def dataset(
    manifest: Union[str, os.PathLike],
    client: Any,
    output: Union[str, os.PathLike],
    *,
    shards: Optional[int] = None,
    threads: Optional[int] = None,
    memory: Optional[int] = None,
    command: Union[str, os.PathLike, None] = None,
    progress: Any = False,
) -> list[Path]:
    """A manifest's runs on the workers of a cluster, as `heightlight dataset` makes them; paths of the tables.

    The runs are those of the program `heightlight`, which workers start: its manifests, locks and folders are the command
    line's. `output`: a folder that the client and all workers share. `shards`: so many shares, each a task (four for each
    worker). `threads`, `memory`: of each worker; those that Dask gave it. `command`: the program, where it is not on PATH.

    The same call goes on where an earlier one was stopped. Raises ValueError for a manifest that makes no sense, OSError
    for one that cannot be read and for runs that fail, with what the program says.
    """
    count = integer("shards", shards, 1) if shards is not None else 4 * max(1, len(client.scheduler_info()["workers"]))
    limit = worker_memory(client) if memory is None else integer("memory", memory, 1, 2**64 - 1)
    program = None if command is None else os.path.abspath(command)
    where = (os.path.abspath(manifest), os.path.abspath(output))
    begun = client.map(run_shard, range(1, count + 1), count=count, where=where, limits=(threads, limit), program=program, pure=False)
    results_of(client, begun, "shards", progress_of(progress))
    run_program(program, where, "--merge")
    return [Path(output, name) for name in ("dataset.csv", "dataset.json", "costs.csv")]
