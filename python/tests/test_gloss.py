"""Specular occlusion, as Python bakes it."""

import numpy as np
import pytest

import heightlight as hl


def test_specular_occlusion_follows_roughness_and_view():
    heights = hl.synth("brick", 48)
    above = hl.bake(heights, "specular-occlusion")["specular-occlusion"]
    assert above.shape == (48, 48)
    assert np.nanmin(above) >= 0 and np.nanmax(above) <= 1
    rough = hl.bake(heights, "specular-occlusion", roughness=0.9)["specular-occlusion"]
    aside = hl.bake(heights, "specular-occlusion", view=(0.5, 0.2, 0.6))["specular-occlusion"]
    assert np.nanmean(np.abs(rough - above)) > 0.01
    assert np.nanmean(np.abs(aside - above)) > 0.01


def test_bad_gloss_is_refused():
    heights = hl.synth("brick", 16)
    with pytest.raises(ValueError, match="roughness"):
        hl.bake(heights, "specular-occlusion", roughness=0)
    with pytest.raises(ValueError, match="view"):
        hl.bake(heights, "specular-occlusion", view=(0, 0, -1))
    with pytest.raises(ValueError, match="view"):
        hl.bake(heights, "specular-occlusion", view=(0, 1))
