"""Closed forms of the total irradiance E/π, as functions of the ambient occlusion and the albedo.

Each form is a function of arrays or numbers, which are broadcast, and of the albedo ρ; it is NaN outside its domain.
The values are those of the C++ library, to the last bit. `names()` lists the forms.

There are two kinds of ambient occlusion, for both of which 1 = open: `alpha`, the fraction of the hemisphere's solid
angle that sees the sky (the AO of Patapom's notes), and `A`, the cosine-weighted one (GTAO's AO). Passing one where the
other is expected ruins the result. Some forms need another input: `n`, the mean sky view factor of what a texel sees
(`Operator.seen`); `W`, the blurred A (`blurred`); or one number per map: `s` (`expected_seen`) or `t`.
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
    """A closed form: a function of its `inputs`, in that order, and the albedo.

    Attributes:
        name, formula, source: name of the form, its formula, and where it comes from.
        inputs: names of the inputs.
    """

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
    """Names of the forms of this module, published forms first."""
    return list(_FORMS)


class UserForm:
    """Your own closed form, written as on the command line: "mine = A/(1 - rho*(1 - A)^k)".

    The formula may use A, alpha, n and rho, and GLSL's functions; other single letters are constants, to be fitted.

    Attributes:
        name, formula: the parts of the text.
        inputs: names of the inputs besides the albedo.
        constants: names of the constants.
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
    """Source text of shader functions, to paste into a shader.

    Args:
        name: name of a form; or your own form, "NAME = FORMULA". None: all forms of this module.
        language: "glsl", "hlsl", "wgsl" or "godot".
        constants: values of the constants of your own form, by name.
    """
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
    """s, the mean of n that reciprocity requires, computed from A and the normals alone.

    `sky_view_factor` is A; `height`, `texel` and `boundary` are those of `sky()`.
    """
    surface, _ = surface_of(height, texel, boundary)
    return _native.expected_seen(surface, numbers("A", sky_view_factor).astype(np.float32))


def blurred(sky_view_factor: np.ndarray, *, tiles: bool = True, sigma: float = 1.5) -> np.ndarray:
    """W, the average of A over a Gaussian of `sigma` texels with weights 1 − A; float32.

    `sky_view_factor` is A; `tiles` says whether the map repeats.
    """
    return _native.blur_seen(numbers("A", sky_view_factor).astype(np.float32), bool(tiles), real("sigma", sigma))


def __getattr__(name: str) -> Callable[..., Any]:
    raise AttributeError(f"heightlight.forms has no form {name}; it has {', '.join(_FORMS)}")
