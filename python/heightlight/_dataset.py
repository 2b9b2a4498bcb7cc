"""Bounce curves of many maps, and closed forms fitted to them."""

from __future__ import annotations

import csv
import json
import os
import re
from dataclasses import dataclass
from typing import Any, Iterable, Mapping, Optional, Sequence, Union

import numpy as np

from . import _native
from ._heights import Heightmap, HeightLike
from ._operator import Curves, operator
from ._settings import integer, real, settings

_COLUMNS = ("ao_kind", "bin", "ao_lo", "ao_hi", "ao_mean", "count", "bounce", "mean", "stddev", "p05", "p50", "p95")


@dataclass
class Run:
    """One map at one relief: its bounce curves, and two estimates of the mean of n.

    Attributes:
        name: name of the run.
        material: name of the material, which several runs may share.
        curves: the bounce curves.
        expected_seen: s, the mean of n that reciprocity requires, computed from A and the normals alone.
        measured_seen: the mean of n that follows from the first bounce.
    """

    name: str
    material: str
    curves: Curves
    expected_seen: Optional[float] = None
    measured_seen: Optional[float] = None


class Dataset(list):
    """A list of `Run`, as `dataset()` returns it."""

    def to_pandas(self) -> Any:
        """All curves in one pandas.DataFrame, with the columns run and map in front."""
        import pandas

        frames = []
        for run in self:
            frame = run.curves.to_pandas()
            frame.insert(0, "map", run.material)
            frame.insert(0, "run", run.name)
            frames.append(frame)
        return pandas.concat(frames, ignore_index=True)

    def save(self, path: Union[str, os.PathLike]) -> None:
        """Writes the dataset.csv that `heightlight fit` reads. It omits the tail, the bounces after the last one."""
        with open(path, "w", newline="", encoding="utf-8") as file:
            table = csv.writer(file, lineterminator="\n")
            table.writerow(("run", "map", *_COLUMNS))
            for run in self:
                columns = [run.curves[name].tolist() for name in _COLUMNS]
                for row in zip(*columns):
                    if row[_COLUMNS.index("bounce")] >= 0:
                        table.writerow((run.name, run.material, *row))


def _material(name: str) -> str:
    """The material of a map, as `heightlight fit` names it: up to the first _, - or ., without digits at its end."""
    return re.sub(r"\d+$", "", re.split(r"[_\-.]", name)[0]) or name


def dataset(
    maps: Union[Mapping[str, HeightLike], Sequence[HeightLike]],
    *,
    relief_shares: Optional[Iterable[float]] = None,
    boundary: Optional[str] = None,
    bounces: int = 20,
    bins: int = 100,
    error: float = 2e-3,
    seed: int = 1,
    threads: Optional[int] = None,
    memory: Optional[int] = None,
    progress: Any = False,
) -> Dataset:
    """Finds the bounce curves of several maps.

    Args:
        maps: a dict from name to heights, or a sequence of heights, which are then named map0, map1, …. Maps whose
            names are equal up to the first _, - or ., without digits at its end, are one material; `fit` leaves them
            out together.
        relief_shares: reliefs as fractions of the width; each map is scaled to each of them. None: each map as it is.
        bounces: how many bounces are kept apart, 2 to 1000.
        bins: number of bins of ambient occlusion, 1 to 10000.

    The other arguments are those of `operator()`.

    Returns:
        A `Dataset` with one `Run` per map and relief.
    """
    named = maps if isinstance(maps, Mapping) else {f"map{i}": map for i, map in enumerate(maps)}
    shares: list[Optional[float]] = [None] if relief_shares is None else [real("relief_shares", share) for share in relief_shares]
    if any(share is not None and not (0 < share < np.inf) for share in shares):
        raise ValueError("relief_shares: must be positive and finite")
    runs = Dataset()
    for name, map in named.items():
        source = map if isinstance(map, Heightmap) else Heightmap(map)
        for share in shares:
            height = source if share is None else _scaled(source, share)
            op = operator(
                height, boundary=boundary, error=error, seed=seed, threads=threads, memory=memory, progress=progress
            )
            alpha, sky, expected, measured = op._curves(bins, integer("bounces", bounces, 2, 1000))
            runs.append(
                Run(
                    name=name if share is None else f"{name}_relief{share:g}",
                    material=_material(name),
                    curves=Curves((alpha, sky)),
                    expected_seen=expected,
                    measured_seen=measured,
                )
            )
    return runs


def _scaled(map: Heightmap, share: float) -> Heightmap:
    heights = map.height.astype(np.float64)
    lowest, highest = np.nanmin(heights), np.nanmax(heights)
    if highest > lowest:
        heights = (heights - lowest) * (share * map.shape[1] * map.texel[0] / (highest - lowest))
    return Heightmap(heights.astype(np.float32), map.texel, map.boundary, curvature=map.curvature)


def fit(
    runs: Iterable[Run],
    *,
    forms: Iterable[str] = (),
    bootstrap: int = 200,
    seed: int = 1,
    threads: Optional[int] = None,
    progress: Any = False,
) -> dict[str, Any]:
    """Fits closed forms to bounce curves, and judges all forms on materials that the fits did not see.

    Does what `heightlight fit` does.

    Args:
        runs: runs, as `dataset()` returns them.
        forms: your own closed forms, "NAME = FORMULA".
        bootstrap: number of bootstrap draws for the confidence intervals of the constants, 20 to 100000.
        seed, threads, progress: as those of `sky()`.

    Returns:
        The content of the command's models.json.
    """
    told = [
        {
            "name": run.name,
            "material": run.material,
            "over_alpha": run.curves.over("ambient_occlusion"),
            "over_sky": run.curves.over("sky_view_factor"),
            "expected_seen": run.expected_seen,
            "measured_seen": run.measured_seen,
        }
        for run in runs
    ]
    own = [forms] if isinstance(forms, str) else [str(form) for form in forms]
    chosen = settings(seed=seed, threads=threads, progress=progress)
    models, _ = _native.fit(told, chosen, own, integer("bootstrap", bootstrap, 20, 100000))
    return json.loads(models)
