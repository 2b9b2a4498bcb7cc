"""Closed forms of the total irradiance E/π, from what a texel is known to be.

Each is a function of arrays or numbers, which are broadcast, and of the albedo ρ; NaN where a form says nothing.
Its values are those of the C++ library, to the last bit. `names()` lists them.

Two kinds of ambient occlusion, both 1 = open: `alpha`, the plain share of the hemisphere's solid angle (the study
notes' AO), and `A`, the cosine-weighted one (GTAO's AO). Feeding one where the other is wanted ruins the result.
Others want one thing more: `n`, the mean sky view factor of what a texel sees (`Operator.seen`), `W`, the blurred
A (`blurred`), or a number per map: `s` (`expected_seen`), `t`.
"""

from __future__ import annotations

from typing import Any, Callable, Optional

import numpy as np

from . import _native
from ._heights import HeightLike, numbers, surface_of
from ._settings import real


def _broadcast(values: dict[str, Any]) -> tuple[tuple[int, ...], dict[str, np.ndarray]]:
    arrays = {name: numbers(name, value).astype(np.float64) for name, value in values.items()}
    try:
        together = np.broadcast_arrays(*arrays.values())
    except ValueError:
        shapes = ", ".join(f"{name} {array.shape}" for name, array in arrays.items())
        raise ValueError(f"shapes that do not go together: {shapes}") from None
    flat = {name: np.ascontiguousarray(array).reshape(-1) for name, array in zip(arrays, together)}
    return together[0].shape, flat


def _result(values: np.ndarray, shape: tuple[int, ...]) -> Any:
    return values.reshape(shape) if shape else float(values[0])


class Form:
    """A closed form: a function of its `inputs` and the albedo."""

    def __init__(self, name: str, formula: str, source: str, inputs: list[str]) -> None:
        self.name = self.__name__ = name
        self.formula = formula
        self.source = source
        self.inputs = tuple(inputs)
        self.__doc__ = f"E/π = {formula}\n\nOf {', '.join(inputs)} and the albedo. Source: {source}."

    def __call__(self, *args: Any, **kwargs: Any) -> Any:
        names = (*self.inputs, "albedo")
        if len(args) > len(names):
            raise TypeError(f"{self.name}() takes {', '.join(names)}: {len(args)} were given")
        values = dict(zip(names, args))
        for name, value in kwargs.items():
            if name not in names or name in values:
                raise TypeError(f"{self.name}() takes {', '.join(names)}, each once, not {name}")
            values[name] = value
        missing = [name for name in names if name not in values]
        if missing:
            raise TypeError(f"{self.name}() misses {', '.join(missing)}")
        shape, flat = _broadcast(values)
        albedo = flat.pop("albedo")
        return _result(_native.evaluate_form(self.name, albedo, flat), shape)

    def __repr__(self) -> str:
        return f"<closed form {self.name}({', '.join((*self.inputs, 'albedo'))}) = {self.formula}>"


_FORMS = {one["name"]: Form(**one) for one in _native.list_forms()}
globals().update(_FORMS)


def names() -> list[str]:
    """The forms of this module, published ones first."""
    return list(_FORMS)


class UserForm:
    """A form of one's own, as the command line takes it: "mine = A/(1 - rho*(1 - A)^k)".

    A formula in A, alpha, n and rho with GLSL's functions; single letters are constants that want fitting.
    """

    def __init__(self, text: str) -> None:
        self._native = _native.UserForm(str(text))
        self.name: str = self._native.name
        self.formula: str = self._native.formula
        self.inputs: tuple[str, ...] = tuple(self._native.inputs)
        self.constants: tuple[str, ...] = tuple(self._native.constants)

    def __call__(self, albedo: Any, *, constants: Optional[dict[str, float]] = None, **inputs: Any) -> Any:
        given = constants or {}
        if set(given) != set(self.constants):
            raise ValueError(f"constants: of {self.name} are {', '.join(self.constants) or 'none'}")
        if set(inputs) != set(self.inputs):
            raise TypeError(f"{self.name} is a function of {', '.join(self.inputs) or 'the albedo alone'}")
        shape, flat = _broadcast({"albedo": albedo, **inputs})
        rho = flat.pop("albedo")
        values = [real("constants", given[name]) for name in self.constants]
        return _result(self._native.evaluate(rho, flat, values), shape)

    def __repr__(self) -> str:
        return f"<form of a user's: {self.name} = {self.formula}>"


def shader(name: Optional[str] = None, language: str = "glsl", *, constants: Optional[dict[str, float]] = None) -> str:
    """Shader functions, to paste: of one form by its name; of a user's form, "NAME = FORMULA", with its constants;
    of all forms where no name is given. `language`: "glsl", "hlsl", "wgsl" or "godot"."""
    if name is None:
        return _native.all_shaders(language)
    if "=" in name:
        form = UserForm(name)
        given = constants or {}
        if set(given) != set(form.constants):
            raise ValueError(f"constants: of {form.name} are {', '.join(form.constants) or 'none'}")
        return form._native.shader(language, [real("constants", given[one]) for one in form.constants])
    return _native.form_shader(name, language)


def expected_seen(sky_view_factor: np.ndarray, height: HeightLike, *, texel: Any = None, boundary: Any = None) -> float:
    """s: the mean of n that reciprocity asks for, from A and the normals alone."""
    surface, _ = surface_of(height, texel, boundary)
    return _native.expected_seen(surface, numbers("A", sky_view_factor).astype(np.float32))


def blurred(sky_view_factor: np.ndarray, *, tiles: bool = True, sigma: float = 1.5) -> np.ndarray:
    """W: A averaged by a Gaussian of `sigma` texels with weights 1 − A; float32."""
    return _native.blur_seen(numbers("A", sky_view_factor).astype(np.float32), bool(tiles), real("sigma", sigma))


def __getattr__(name: str) -> Callable[..., Any]:
    raise AttributeError(f"heightlight.forms has no form {name}; it has {', '.join(_FORMS)}")
