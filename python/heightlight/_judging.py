"""Finds the error of a closed form on maps."""

from __future__ import annotations

import inspect
from dataclasses import dataclass, field
from typing import Any, Callable, Iterable, Mapping, Optional, Sequence, Union

import numpy as np

from . import forms as closed_forms
from ._dataset import _material
from ._heights import Heightmap, HeightLike
from ._operator import Operator, operator
from ._settings import integer, real

_INPUTS = ("A", "alpha", "n", "s", "W")
_ALBEDO = ("rho", "albedo")
_MOST_TEXELS = 65536  # of one map, used in fits


@dataclass
class Judgement:
    """What `judge()` returns. All errors are in E/π: the form minus light transport.

    Attributes:
        rmse: RMSE over all maps and albedos; each map has the same weight.
        bias: mean error over all maps and albedos, with the same weights.
        by_albedo: RMSE by albedo.
        by_map: RMSE by name of the map.
        by_ao: for each filled bin of the form's AO: "ao", its mean, and "count", both (bins); and "rmse" and "bias" by
            albedo, both (albedos, bins). Empty if the form uses neither A nor alpha.
        constants: the form's constants, fitted to all maps; empty if it has none.
        left_out: RMSE if each material is judged with constants that were fitted to the other materials; None without
            constants, or with only one material.
        outside_share: fraction of the values, over texels and albedos, for which the form gives no finite number; no
            error includes them.
        reference_rmse: error of light transport itself, the largest that its checks found.
    """

    rmse: float
    bias: float
    by_albedo: dict[float, float]
    by_map: dict[str, float]
    by_ao: dict[str, np.ndarray]
    constants: dict[str, float]
    left_out: Optional[float]
    outside_share: float
    reference_rmse: float


@dataclass
class _Signature:
    inputs: list[str]
    albedo: str
    constants: list[str]
    start: list[float]
    call: Callable[..., Any]


@dataclass
class _Map:
    name: str
    material: str
    inputs: dict[str, np.ndarray] = field(default_factory=dict)
    totals: np.ndarray = field(default_factory=lambda: np.empty((0, 0)))  # albedos × texels
    reference_rmse: float = 0.0


def _read_signature(form: Any) -> _Signature:
    if isinstance(form, str):
        form = closed_forms.UserForm(form)
    if isinstance(form, closed_forms.UserForm):
        own = form

        def call(rho: Any, **values: Any) -> Any:
            constants = {name: values.pop(name) for name in own.constants}
            return own(rho, constants=constants, **values)

        return _Signature(list(own.inputs), "rho", list(own.constants), [1.0] * len(own.constants), call)
    if isinstance(form, closed_forms.Form):
        if "t" in form.inputs:
            raise ValueError(f"form {form.name}: wants t, which is tuned to a simulation")
        return _Signature(list(form.inputs), "albedo", [], [], form)
    if not callable(form):
        raise ValueError("form: must be a function, a closed form, or 'NAME = FORMULA'")
    parameters = inspect.signature(form).parameters
    inputs = [name for name in parameters if name in _INPUTS]
    albedo = [name for name in parameters if name in _ALBEDO]
    if not inputs or len(albedo) != 1:
        raise ValueError(f"form: must be a function of rho and of one or more of {', '.join(_INPUTS)}")
    constants = [name for name in parameters if name not in (*_INPUTS, *_ALBEDO)]
    start = [1.0 if parameters[name].default is inspect.Parameter.empty else real(name, parameters[name].default) for name in constants]
    return _Signature(inputs, albedo[0], constants, start, form)


def _inputs(op: Operator, height: Heightmap, wanted: Iterable[str]) -> dict[str, np.ndarray]:
    found: dict[str, np.ndarray] = {}
    sky = op.sky_view_factor
    for name in wanted:
        if name == "A":
            found[name] = sky
        elif name == "alpha":
            found[name] = op.ambient_occlusion
        elif name == "n":
            found[name] = op.seen
        elif name == "W":
            found[name] = closed_forms.blurred(sky, tiles=height.boundary == "tile")
        else:
            found[name] = np.full(op.shape, closed_forms.expected_seen(sky, height))
    return {name: values.astype(np.float64).ravel() for name, values in found.items()}


def _solve(name: str, height: HeightLike, wanted: Iterable[str], albedos: list[float], options: dict[str, Any]) -> _Map:
    source = height if isinstance(height, Heightmap) else Heightmap(height)
    op = operator(source, **options)
    totals, evidence = op._native.totals(albedos)
    op._evidence = evidence
    checks = op.evidence.get("visibility", {}).get("checked", {}).get("total_rmse_by_albedo", [])
    present = ~np.isnan(op.direct).ravel()
    return _Map(
        name=name,
        material=_material(name),
        inputs={key: values[present] for key, values in _inputs(op, source, wanted).items()},
        totals=np.stack([total.ravel()[present] for total in totals]),
        reference_rmse=max(checks, default=0.0),
    )


def _evaluate(form: _Signature, map: _Map, albedos: list[float], constants: Iterable[float]) -> np.ndarray:
    """The form's values, (albedos, texels)."""
    values = []
    for albedo in albedos:
        given = {**map.inputs, form.albedo: albedo, **dict(zip(form.constants, constants))}
        with np.errstate(all="ignore"):
            value = np.asarray(form.call(**given), dtype=np.float64)
        values.append(np.broadcast_to(value, map.totals[0].shape))
    return np.stack(values)


def _thinned(map: _Map) -> _Map:
    step = -(-map.totals.shape[1] // _MOST_TEXELS)
    return _Map(map.name, map.material, {key: one[::step] for key, one in map.inputs.items()}, map.totals[:, ::step])


def _fit(form: _Signature, maps: Sequence[_Map], albedos: list[float]) -> list[float]:
    from scipy.optimize import least_squares

    def residuals(constants: np.ndarray) -> np.ndarray:
        parts = []
        for map in maps:
            errors = _evaluate(form, map, albedos, constants) - map.totals
            parts.append(np.nan_to_num(errors, nan=1.0, posinf=1.0, neginf=-1.0).ravel() / np.sqrt(errors.size))
        return np.concatenate(parts)

    return [float(value) for value in least_squares(residuals, form.start, x_scale="jac").x]


def _mean_square(maps: Sequence[_Map], errors: Sequence[np.ndarray]) -> float:
    return float(np.mean([np.nanmean(one**2) for one in errors])) if maps else float("nan")


def judge(
    form: Union[str, Callable[..., Any]],
    maps: Union[Mapping[str, HeightLike], Sequence[HeightLike]],
    *,
    albedos: Sequence[float] = (0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9),
    bins: int = 20,
    error: float = 2e-3,
    seed: int = 1,
    threads: Optional[int] = None,
    memory: Optional[int] = None,
    progress: Any = False,
) -> Judgement:
    """Finds the error of a closed form against light transport.

    Args:
        form: a function of arrays, whose parameter names say what it uses: `rho` (or `albedo`), and one or more of
            `A`, `alpha`, `n`, `s` and `W` (see `heightlight.forms`). Any other parameter is a constant. Constants are
            fitted, starting from their defaults (1 without a default); this requires scipy. `form` may also be a
            closed form of `heightlight.forms`, or a text "NAME = FORMULA".
        maps: a dict from name to heights, or a sequence of heights. Maps whose names are equal up to the first _ - or
            ., without digits at its end, are one material; each material is also judged with constants that were
            fitted to the others (`left_out`).
        albedos: the albedos at which the form is judged.
        bins: number of bins of AO, 1 to 10000.

    The other arguments are those of `operator()`.

    Returns:
        A `Judgement`.

    Raises:
        ValueError: for arguments that make no sense.
    """
    signature = _read_signature(form)
    rhos = [real("albedos", albedo) for albedo in albedos]
    bins = integer("bins", bins, 1, 10000)
    named = maps if isinstance(maps, Mapping) else {f"map{i}": map for i, map in enumerate(maps)}
    if not named or not rhos:
        raise ValueError("maps: at least one, and one albedo, are wanted")
    options = {"error": error, "seed": seed, "threads": threads, "memory": memory, "progress": progress}
    solved = [_solve(str(name), height, signature.inputs, rhos, options) for name, height in named.items()]

    thinned = [_thinned(map) for map in solved]
    constants = _fit(signature, thinned, rhos) if signature.constants else []
    errors = [_evaluate(signature, map, rhos, constants) - map.totals for map in solved]
    outside = [~np.isfinite(one) for one in errors]
    for one, hole in zip(errors, outside):
        one[hole] = np.nan
    return Judgement(
        rmse=_mean_square(solved, errors) ** 0.5,
        bias=float(np.mean([np.nanmean(one) for one in errors])),
        by_albedo={rho: float(np.mean([np.nanmean(one[i] ** 2) for one in errors])) ** 0.5 for i, rho in enumerate(rhos)},
        by_map={map.name: float(np.nanmean(one**2)) ** 0.5 for map, one in zip(solved, errors)},
        by_ao=_by_ao(signature, solved, errors, bins),
        constants=dict(zip(signature.constants, constants)),
        left_out=_left_out(signature, solved, thinned, rhos),
        outside_share=float(np.mean([hole.mean() for hole in outside])),
        reference_rmse=max(map.reference_rmse for map in solved),
    )


def _mean(values: np.ndarray) -> np.ndarray:
    """Mean along each row of the finite values; NaN in rows without any."""
    finite = np.isfinite(values)
    sums = np.where(finite, values, 0).sum(axis=1)
    return np.where(finite.any(axis=1), sums / np.maximum(finite.sum(axis=1), 1), np.nan)


def _by_ao(form: _Signature, maps: Sequence[_Map], errors: Sequence[np.ndarray], bins: int) -> dict[str, np.ndarray]:
    kind = "A" if "A" in form.inputs else "alpha" if "alpha" in form.inputs else None
    if kind is None:
        return {}
    ao = np.concatenate([map.inputs[kind] for map in maps])
    every = np.concatenate(errors, axis=1)
    bin_of = np.minimum((ao * bins).astype(int), bins - 1)
    filled = np.unique(bin_of)
    parts = [every[:, bin_of == one] for one in filled]
    return {
        "ao": np.array([ao[bin_of == one].mean() for one in filled]),
        "rmse": np.sqrt(np.stack([_mean(part**2) for part in parts], axis=1)),
        "bias": np.stack([_mean(part) for part in parts], axis=1),
        "count": np.array([part.shape[1] for part in parts]),
    }


def _left_out(form: _Signature, maps: Sequence[_Map], thinned: Sequence[_Map], albedos: list[float]) -> Optional[float]:
    materials = sorted({map.material for map in maps})
    if not form.constants or len(materials) < 2:
        return None
    errors = []
    for material in materials:
        constants = _fit(form, [map for map in thinned if map.material != material], albedos)
        for map in maps:
            if map.material == material:
                error = _evaluate(form, map, albedos, constants) - map.totals
                errors.append(np.where(np.isfinite(error), error, np.nan))
    return _mean_square(maps, errors) ** 0.5
