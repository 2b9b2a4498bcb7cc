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
    """One map at one relief: its curves, and what its sky says of n (s, and n's mean as the first bounce has it)."""

    name: str
    material: str
    curves: Curves
    expected_seen: Optional[float] = None
    measured_seen: Optional[float] = None


class Dataset(list):
    """Runs, as `dataset()` makes them."""

    def to_pandas(self) -> Any:
        """All curves below each other, with the columns run and map in front."""
        import pandas

        frames = []
        for run in self:
            frame = run.curves.to_pandas()
            frame.insert(0, "map", run.material)
            frame.insert(0, "run", run.name)
            frames.append(frame)
        return pandas.concat(frames, ignore_index=True)

    def save(self, path: Union[str, os.PathLike]) -> None:
        """As the dataset.csv that `heightlight fit` reads: without what comes after the last bounce."""
        with open(path, "w", newline="", encoding="utf-8") as file:
            table = csv.writer(file, lineterminator="\n")
            table.writerow(("run", "map", *_COLUMNS))
            for run in self:
                columns = [run.curves[name].tolist() for name in _COLUMNS]
                for row in zip(*columns):
                    if row[_COLUMNS.index("bounce")] >= 0:
                        table.writerow((run.name, run.material, *row))


def _material(name: str) -> str:
    """As `heightlight fit` has it: up to the first _, - or ., without digits at its end."""
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
    """Bounce curves of maps, by name or in order; each as it is, or once per relief share (peak to valley over the
    width). Maps whose names begin alike are one material, and are left out together by `fit`."""
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
    """Closed forms fitted to the curves, and all forms judged on materials that no fit saw, as `heightlight fit`
    does: the content of its models.json. `forms`: of one's own, "NAME = FORMULA"."""
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
