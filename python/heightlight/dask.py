"""Bakes and datasets on a Dask cluster.

    from dask.distributed import Client
    import heightlight as hl

    client = Client("scheduler:8786")
    maps = hl.dask.bake("alps.tif", client, maps=("ao", "bent-normal"))   # an xarray.Dataset, read lazily
    tables = hl.dask.dataset("study.json", client, "study")

This module only distributes windows and runs to workers. The results are those of one process, to the last bit,
however many workers there are and whichever are lost. The client and all workers must share one file system, which
holds all files, and the package must be installed on each of them.
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
    """Bakes maps of a material, as `heightlight.bake` does, window by window on the workers of a cluster.

    The same call continues what an earlier one left in the work folder; a different call begins anew. Hence datasets
    that are to be read at the same time need separate work folders. A total that turns out to miss `error` is computed
    once more, as in `heightlight.bake`.

    Args:
        source: the path of a heightmap; or an xarray.DataArray with coordinates that its accessor `heightlight`
            understands. Chunks of a Dask array go to the workers that need them; no process gets all of them.
        client: a distributed.Client.
        maps: names of maps, as for `heightlight.bake`.
        window: side of a window in texels, a multiple of 64. Results do not depend on it.
        output: a folder to which the maps are written. None: they are returned as a dataset.
        folder: the work folder, on the file system that the client and all workers share. None: NAME.windows in the
            client's current folder, or .NAME.windows in `output`.
        name: the beginning of the files' names (NAME). None: the name of the source.
        format: format of the files, as in `Bake.save`. None: "tif" for terrain, "png" for materials.
        depth: depth of the samples, as in `Bake.save`.
        threads: threads per worker. None: as many as Dask gave the worker.
        memory: bytes per worker. None: four fifths of the limit that Dask gave the worker.
        reading: further arguments of `heightlight.read`, if `source` is a path.

    The other arguments are those of `heightlight.bake`.

    Returns:
        Without `output`, an xarray.Dataset with a variable per map. It has the source's coordinates, or world units
        from the lower left corner for a file without a georeference. A map of several channels has a dimension
        NAME-channel, where NAME is the name of the map. The attribute `evidence` is that of `Bake`, as JSON. Its chunks
        are the windows, which are read from the work folder on demand, so that this folder must stay as long as the
        dataset is used.

        With `output`, the paths of the files, which are those of `heightlight bake`: GeoTIFFs for terrain, PNGs for
        materials, and NAME_bake.json. The work folder is then removed.

    Raises:
        ValueError: for arguments that make no sense, and for what windows cannot do: "ao-n"; the definitions of terrain
            science; an albedo that varies; "multibounce" with a max_distance, or with a sky that ends at the
            horizontal; and maps that tile and whose sides are not multiples of 8 (of 64 for very large maps).
        MemoryError: if a window does not fit in the memory of a worker.
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
            "format": "exr" if output is None else format,  # without files: keeps all channels of each map
            "depth": "" if depth is None or output is None else str(depth),
        },
    )
    task.share()  # raises ValueError for what windows cannot do
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
    """Begins the bake of an xarray.DataArray."""
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
    """Does the runs of a manifest on the workers of a cluster, as `heightlight dataset` does them.

    The workers start the program `heightlight`, so that manifests, locks and folders are those of the command line. The
    same call continues where an earlier one was stopped.

    Args:
        manifest: path of the manifest.
        client: a distributed.Client.
        output: a folder that the client and all workers share.
        shards: number of parts into which the runs are divided; each is one task. None: four per worker.
        threads: threads per worker. None: as many as Dask gave the worker.
        memory: bytes per worker. None: four fifths of the limit that Dask gave the worker.
        command: path of the program, if it is not on PATH.
        progress: as for `heightlight.sky`.

    Returns:
        The paths of the tables: dataset.csv, dataset.json and costs.csv.

    Raises:
        ValueError: for a manifest that makes no sense, with the program's message.
        OSError: for a manifest that cannot be read and for runs that fail, with the program's message.
    """
    count = integer("shards", shards, 1) if shards is not None else 4 * max(1, len(client.scheduler_info()["workers"]))
    limit = worker_memory(client) if memory is None else integer("memory", memory, 1, 2**64 - 1)
    program = None if command is None else os.path.abspath(command)
    where = (os.path.abspath(manifest), os.path.abspath(output))
    begun = client.map(run_shard, range(1, count + 1), count=count, where=where, limits=(threads, limit), program=program, pure=False)
    results_of(client, begun, "shards", progress_of(progress))
    run_program(program, where, "--merge")
    return [Path(output, name) for name in ("dataset.csv", "dataset.json", "costs.csv")]
