"""A form of one's own on trial, and the study notes' curves.

    python3 judge_a_form.py OUT
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
maps = {name: hl.synth(name, 128) for name in ("brick", "cobbles", "concrete", "fbm")}


def mine(A, rho, k=1.0):
    """What is seen is lighter than the texel itself the deeper the texel lies."""
    return A / (1 - rho * (1 - A) ** k)


judged = hl.judge(mine, maps)
print(f"mine: k = {judged.constants['k']:.3f}, RMSE {judged.rmse:.4f}, on materials left out {judged.left_out:.4f}")
for name in ("direct", "cubic", "uniform_neighbourhood", "notes_guarded", "seen_stored"):
    other = hl.judge(getattr(hl.forms, name), maps)
    print(f"{name}: RMSE {other.rmse:.4f}, bias {other.bias:+.4f}")
print(f"(light transport itself errs by {judged.reference_rmse:.4f})")

curves = hl.operator(maps["brick"]).curves()
figure, (left, right) = plt.subplots(1, 2, figsize=(12, 4.5), layout="constrained")
for bounce in (0, 1, 2, 4, 8, 16):
    ao, mean = curves.bounce(bounce)
    left.plot(ao, mean, label=f"bounce {bounce}")
left.set(xlabel="ambient occlusion α, 1 = open", ylabel="E/π at albedo 1", title="Bounce curves of the brick wall")
left.legend()
for name, form in (("mine", lambda A, rho: mine(A, rho, judged.constants["k"])), ("cubic", hl.forms.cubic), ("eq. 12", hl.forms.uniform_neighbourhood)):
    A = np.linspace(0, 1, 200)
    right.plot(A, form(A, 0.8), label=name)
op = hl.operator(maps["brick"])
right.scatter(op.direct.ravel()[::7], op.solve(0.8).ravel()[::7], s=1, c="0.7", label="texels of the brick wall")
right.set(xlabel="sky view factor A, 1 = open", ylabel="E/π of all bounces", title="Forms at albedo 0.8")
right.legend()
figure.savefig(out / "judge_a_form.png", dpi=100)
