"""An artist's batch: the maps of several materials, baked and looked at.

    python3 artist_batch.py OUT [HEIGHTMAP …]

Without heightmaps, some are made.
"""

import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

import heightlight as hl

out = Path(sys.argv[1])
out.mkdir(parents=True, exist_ok=True)
files = [Path(name) for name in sys.argv[2:]]
if files:
    materials = {file.stem: hl.read(file) for file in files}
else:
    materials = {name: hl.synth(name, 256, relief=relief) for name, relief in (("brick", 0.05), ("cobbles", 0.1), ("concrete", 0.05))}

figure, axes = plt.subplots(len(materials), 4, figsize=(12, 3.2 * len(materials)), squeeze=False, layout="constrained")
for row, (name, height) in zip(axes, materials.items()):
    bake = hl.bake(height, ["ao", "multibounce", "bent-normal"], albedo=[0.7, 0.5, 0.4])
    bake.save(out / name, name)
    error = bake.evidence["visibility"]["rmse_estimate"]
    row[0].imshow(height.height, cmap="gray")
    row[1].imshow(bake["ao"], cmap="gray", vmin=0, vmax=1)
    row[2].imshow(bake["multibounce"].clip(0, 1))
    row[3].imshow(bake["bent-normal"] / 2 + 0.5)
    titles = (f"{name}: height", f"AO, RMSE {error:.4f}", "all bounces, in colour", "bent normal")
    for axis, title in zip(row, titles):
        axis.set_title(title)
        axis.set_axis_off()
figure.savefig(out / "artist_batch.png", dpi=100)
