"""Ambient occlusion, form factors and light bounces over height fields.

    import heightlight as hl

    brick = hl.synth("brick", 256)             # or hl.read("height.png"), or any 2-D array
    sky = hl.sky(brick)                        # each quantity is computed when you ask for it
    sky.sky_view_factor                        # A, 1 = open
    op = hl.operator(brick)                    # F, which carries irradiance from one bounce to the next
    total = op.solve(albedo=0.5)               # E/pi of all bounces
    hl.forms.cubic(sky.sky_view_factor, 0.5)   # the same total, by a closed form

Arrays have the shape (rows, columns), with row 0 at the image's top. World axes: x points right, y up the
image, z out of it. NaN means missing, in heights and in results. Irradiance is given as E/pi, which is 1 at an
unoccluded place under a sky of radiance 1.
"""

from importlib import import_module
from typing import Any

from . import forms
from ._baking import Bake, bake, maps
from ._comparing import Comparison, compare
from ._dataset import Dataset, Run, dataset, fit
from ._heights import Heightmap, read, read_sky, shapes, synth
from ._judging import Judgement, judge
from ._light import sky_irradiance, sun_irradiance
from ._native import version as __version__
from ._operator import Curves, Operator, operator
from ._sky import Sky, definitions, sky
from .forms import shader

__all__ = [
    "Bake",
    "Comparison",
    "Curves",
    "Dataset",
    "Heightmap",
    "Judgement",
    "Operator",
    "Run",
    "Sky",
    "bake",
    "compare",
    "dataset",
    "definitions",
    "fit",
    "forms",
    "judge",
    "maps",
    "operator",
    "read",
    "read_sky",
    "shader",
    "shapes",
    "sky",
    "sky_irradiance",
    "sun_irradiance",
    "synth",
]

try:
    from . import _xarray  # noqa: F401  registers the accessor if xarray is installed
except ImportError:
    pass


def __getattr__(name: str) -> Any:
    if name == "dask":  # its dependencies are imported only on demand
        return import_module(f"{__name__}.dask")
    raise AttributeError(f"module {__name__} has no attribute {name}")
