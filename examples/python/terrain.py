"""The sky view factor of a digital elevation model, through rioxarray.

    python3 terrain.py OUT [DEM.tif [TEXEL]]

Without a model, one is made, with a place on earth. A file that has none wants its spacing, in metres.
"""

import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import rioxarray
import xarray as xr

import heightlight as hl  # registers the accessor

out = Path(sys.argv[1])
out.mkdir(parents=True, exist_ok=True)
if len(sys.argv) > 2:
    path = Path(sys.argv[2])
else:
    path = out / "dem.tif"
    side, step = 200, 25.0
    heights = 800 + hl.synth("fbm", side, relief=900).height
    place = {"y": 1_200_000 - step * np.arange(side), "x": 2_600_000 + step * np.arange(side)}
    xr.DataArray(heights, dims=("y", "x"), coords=place).rio.write_crs("EPSG:2056").rio.to_raster(path)

dem = rioxarray.open_rasterio(path, masked=True).squeeze("band", drop=True)
texel = float(sys.argv[3]) if len(sys.argv) > 3 else None
view = dem.heightlight.sky_view_factor(texel=texel)
print(f"{path.name}: {view.sizes['y']} × {view.sizes['x']}, CRS {view.rio.crs}, mean sky view factor {float(view.mean()):.4f}")
view.rio.to_raster(out / "sky_view_factor.tif")

figure, (left, right) = plt.subplots(1, 2, figsize=(12, 5), layout="constrained")
dem.plot(ax=left, cmap="terrain", cbar_kwargs={"label": "height, m"})
view.plot(ax=right, cmap="gray", vmax=1, cbar_kwargs={"label": "sky view factor, 1 = open"})
for axis, title in ((left, "Heights"), (right, "Sky view factor")):
    axis.set_title(title)
    axis.set_aspect("equal")
figure.savefig(out / "terrain.png", dpi=100)
