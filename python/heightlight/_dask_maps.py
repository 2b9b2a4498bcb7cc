"""Maps of a finished bake, read window by window from its work folder."""

from __future__ import annotations

from typing import Any

import dask.array
import numpy as np
import xarray as xr

from . import _native
from ._baking import maps as known_maps
from ._dask_work import Task


def _read_window(work: str, request: str, window: int, first: int, count: int) -> np.ndarray:
    """Channels of a window of finished maps: (rows, columns), or (rows, columns, channels)."""
    channels = _native.read_baked_window(work, request, window, first, count)
    return channels[0] if count == 1 else np.moveaxis(channels, 0, -1)


def _lazy(task: Task, share: Any, name: str, first: int) -> Any:
    """A map of a finished bake, as a Dask array whose chunks are the windows."""
    (rows, columns), window = share.facts["shape"], share.facts["window"]
    channels = share.channels(name)
    chunks: list[tuple[int, ...]] = [tuple(min(window, side - start) for start in range(0, side, window)) for side in (rows, columns)]
    across = len(chunks[1])
    work, request = task.place["folder"], task.place["request"]
    key = f"heightlight-{name}-{task.mark}"
    behind = () if channels == 1 else (0,)
    graph = {
        (key, i, j, *behind): (_read_window, work, request, i * across + j, first, channels)
        for i in range(len(chunks[0]))
        for j in range(across)
    }
    if channels > 1:
        chunks.append((channels,))
    return dask.array.Array(graph, key, tuple(chunks), dtype=np.float32)


def _places(facts: dict[str, Any]) -> dict[str, Any]:
    """Coordinates of a file's samples: its georeference, else world units from the lower left corner."""
    rows, columns = facts["shape"]
    step_x, step_y = facts.get("cell", facts["texel"]) if "corner" in facts else facts["texel"]
    left, top = facts.get("corner", (0.0, rows * step_y))
    units = {"units": "degrees"} if facts.get("in_degrees") and "corner" in facts else {}
    return {
        "y": ("y", top - (np.arange(rows) + 0.5) * step_y, units),
        "x": ("x", left + (np.arange(columns) + 0.5) * step_x, units),
    }


def dataset_of(task: Task, share: Any, source: Any, texel: Any) -> Any:
    """All maps as a dataset, with the orientation of the source."""
    variables = {}
    first = 0
    for name in task.maps:
        values = _lazy(task, share, name, first)
        first += share.channels(name)
        attributes = {"long_name": known_maps()[name]}
        dims: tuple[Any, ...] = ("y", "x")
        if source is not None:
            values = source.heightlight._turn(values, texel)
            attributes = source.heightlight._attributes(known_maps()[name], "1")
            dims = source.dims
        variables[name] = (dims if values.ndim == 2 else (*dims, f"{name}-channel"), values, attributes)
    coordinates = _places(share.facts) if source is None else source.coords
    told = {"evidence": share.evidence}
    if source is None and share.facts.get("system"):
        told["crs"] = share.facts["system"]
    return xr.Dataset(variables, coordinates, told)
