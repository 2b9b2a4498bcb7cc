"""Sun and sky on snow: what slopes throw on each other.

    python3 snow.py OUT

The sun is light of one's own: its shadows come from the horizon toward it, and all bounces follow from the same
operator as those of the sky.
"""

import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import heightlight as hl

out = Path(sys.argv[1])
out.mkdir(parents=True, exist_ok=True)
side, step = 200, 25.0
terrain = hl.Heightmap(hl.synth("fbm", side, relief=1200).height, step, "open")
azimuth, elevation = np.radians(150), np.radians(20)  # from x toward y: low in the north-west
sun_normal, sky_radiance = 600.0, 100 / np.pi  # W/m² across its rays; W/m² sr
snow = 0.85

toward = np.array([np.cos(elevation) * np.cos(azimuth), np.cos(elevation) * np.sin(azimuth), np.sin(elevation)])
y, x = np.gradient(terrain.height.astype(float), step)
normal = np.stack([-x, y, np.ones_like(x)], axis=-1) / np.sqrt(1 + x**2 + y**2)[:, :, None]  # rows go down
lit = hl.sky(terrain).horizons([azimuth])[0] < elevation
sun = sun_normal * lit * np.clip(normal @ toward, 0, None)

op = hl.operator(terrain)
direct = sun + np.pi * sky_radiance * op.direct  # W/m²
total = np.pi * op.solve(snow, direct / np.pi)
thrown = total - direct
print(f"mean irradiance {total.mean():.0f} W/m²: {sun.mean():.0f} of the sun, {thrown.mean():.0f} from other slopes (up to {thrown.max():.0f})")

figure, axes = plt.subplots(1, 3, figsize=(15, 4.6), layout="constrained")
for axis, values, title in zip(axes, (direct, thrown, thrown / direct), ("Sun and sky, W/m²", "From other slopes, W/m²", "The same, as a share of sun and sky")):
    image = axis.imshow(values, cmap="magma", vmax=np.quantile(values, 0.995))
    axis.set_title(title)
    axis.set_axis_off()
    figure.colorbar(image, ax=axis)
figure.savefig(out / "snow.png", dpi=100)
