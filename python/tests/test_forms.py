"""Closed forms."""

import math
import subprocess

import numpy as np
import pytest

import heightlight as hl


def test_forms_are_those_of_the_papers():
    assert hl.forms.direct(0.3, 0.7) == 0.3
    assert hl.forms.uniform_neighbourhood(0.5, 0.8) == pytest.approx(0.5 / (1 - 0.8 * 0.5), abs=1e-15)
    a, b, c = 2.0404 * 0.5 - 0.3324, 4.7951 * 0.5 - 0.6417, 2.7552 * 0.5 + 0.6903
    assert hl.forms.cubic(0.4, 0.5) == pytest.approx(max(0.4, a * 0.4**3 - b * 0.4**2 + c * 0.4), abs=1e-12)
    direct = 0.4 * (1 + 0.5 * 0.6**0.75)
    first = 27.576937094210385 * 0.4 * 0.6**1.5 * math.exp(-3.3364392003423804 * 0.4**0.25)
    tau = 1 - first / (1 - direct)
    assert hl.forms.notes(0.4, 0.5) == pytest.approx(direct + 0.5 * first / (1 - 0.5 * tau), abs=1e-12)


def test_every_form_is_vectorised():
    values = np.linspace(0.05, 0.9, 12)
    for name in hl.forms.names():
        form = getattr(hl.forms, name)
        inputs = {one: values for one in form.inputs}
        together = form(**inputs, albedo=np.array([[0.2], [0.7]]))
        assert together.shape == (2, 12)
        for i, albedo in enumerate((0.2, 0.7)):
            for j, value in enumerate(values):
                assert together[i, j] == form(*[value] * len(form.inputs), albedo)
        assert form.__doc__ and form.source


def test_values_are_those_of_cplusplus(tmp_path):
    """To the last bit: forms.h compiled by itself."""
    source = """
#include <cstdio>
#include <heightlight/forms.h>
using namespace heightlight;
int main() {
  for (int i = 0; i <= 20; ++i)
    for (int j = 0; j <= 20; ++j)
      std::printf("%a %a %a %a\\n", cubic_total(SkyViewFactor{i / 20.0}, j / 20.0),
                  notes_total(AmbientOcclusion{i / 20.0}, j / 20.0),
                  bounced_total(SkyViewFactor{i / 20.0}, guess_seen(SkyViewFactor{i / 20.0}), j / 20.0),
                  uniform_neighbourhood(SkyViewFactor{i / 20.0}, j / 20.0));
}
"""
    import os
    from pathlib import Path

    include = Path(__file__).resolve().parents[2] / "include"
    (tmp_path / "forms.cpp").write_text(source)
    compiler = os.environ.get("CXX", "c++")
    done = subprocess.run([compiler, "-std=c++17", "-O2", "-ffp-contract=off", "-I", include, "forms.cpp", "-o", "forms"], cwd=tmp_path)
    assert done.returncode == 0
    told = subprocess.run([tmp_path / "forms"], capture_output=True, text=True, check=True).stdout.split()
    values = np.array([float.fromhex(word) if "nan" not in word else np.nan for word in told]).reshape(21, 21, 4)
    ao, albedo = np.arange(21)[:, None] / 20.0, np.arange(21)[None, :] / 20.0
    for column, name in enumerate(("cubic", "notes", "seen_from_sky", "uniform_neighbourhood")):
        np.testing.assert_array_equal(getattr(hl.forms, name)(ao, albedo), values[:, :, column])


def test_nan_is_missing_and_forms_say_nothing_outside_their_domain():
    assert math.isnan(hl.forms.cubic(math.nan, 0.5))
    assert math.isnan(hl.forms.notes(0.97, 0.5))
    assert hl.forms.notes_guarded(0.97, 0.5) == 1


def test_wrong_calls_say_what_is_wanted():
    with pytest.raises(TypeError, match="misses albedo"):
        hl.forms.cubic(0.5)
    with pytest.raises(TypeError, match="not alpha"):
        hl.forms.cubic(alpha=0.5, albedo=0.5)
    with pytest.raises(ValueError, match="do not go together"):
        hl.forms.cubic(np.zeros(3), np.zeros(4))
    with pytest.raises(AttributeError, match="has no form quartic"):
        hl.forms.quartic


def test_a_form_of_ones_own():
    form = hl.forms.UserForm("mine = A/(1 - rho*(1 - A)^k)")
    assert form.inputs == ("A",) and form.constants == ("k",)
    assert form(0.5, A=0.25, constants={"k": 2}) == pytest.approx(0.25 / (1 - 0.5 * 0.75**2), abs=1e-15)
    with pytest.raises(ValueError, match="constants"):
        form(0.5, A=0.25)
    with pytest.raises(ValueError, match="column"):
        hl.forms.UserForm("mine = A/(")


def test_shaders():
    for language, three in (("glsl", "vec3"), ("hlsl", "float3"), ("wgsl", "vec3<f32>"), ("godot", "vec3")):
        for name in hl.forms.names():
            if name.startswith("direct"):
                with pytest.raises(ValueError, match="has no shader"):
                    hl.shader(name, language)
            else:
                assert three in hl.shader(name, language)
        assert "heightlight_cubic" in hl.shader(language=language)
    mine = hl.shader("mine = A^k", constants={"k": 2})
    assert "pow" in mine and "float heightlight_share(" in mine
    with pytest.raises(ValueError, match="language"):
        hl.shader("cubic", "cg")


def test_judging_a_form():
    maps = {"brick": hl.synth("brick", 48), "cobbles_1": hl.synth("cobbles", 48), "cobbles_2": hl.synth("cobbles", 48, seed=2)}

    def mine(A, rho, k=1.0):
        return A / (1 - rho * (1 - A) ** k)

    judged = hl.judge(mine, maps, albedos=(0.3, 0.6))
    assert judged.constants["k"] == pytest.approx(0.95, abs=0.3)
    assert judged.rmse <= hl.judge(lambda A, rho: A / (1 - rho * (1 - A)), maps, albedos=(0.3, 0.6)).rmse + 1e-9
    assert judged.left_out >= judged.rmse - 1e-9
    assert set(judged.by_map) == set(maps) and set(judged.by_albedo) == {0.3, 0.6}
    assert judged.by_ao["count"].sum() == 3 * 48 * 48
    assert judged.by_ao["rmse"].shape == (2, len(judged.by_ao["ao"])) == judged.by_ao["bias"].shape
    assert 0 < judged.reference_rmse < 0.01
    text = hl.judge("mine = A/(1 - rho*(1 - A)^k)", maps, albedos=(0.3, 0.6))
    assert text.rmse == pytest.approx(judged.rmse, rel=1e-4)
    known = hl.judge(hl.forms.notes, maps, albedos=(0.3, 0.6))
    assert known.outside_share > 0 and known.left_out is None
    stored = hl.judge(hl.forms.seen_stored, maps, albedos=(0.3, 0.6))
    assert stored.rmse < 0.25 * known.rmse
    with pytest.raises(ValueError, match="function of rho"):
        hl.judge(lambda x: x, maps)
