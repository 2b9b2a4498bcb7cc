"""Rasters of terrain keep their place on earth, as GDAL reads it through rasterio."""

import struct
import subprocess
import os

import numpy as np
import pytest

import heightlight as hl

rasterio = pytest.importorskip("rasterio", reason="rasterio is absent: GEOTIFFS ARE NOT CHECKED")
from rasterio.control import GroundControlPoint  # noqa: E402
from rasterio.transform import Affine, from_origin  # noqa: E402

pytestmark = pytest.mark.filterwarnings("ignore")  # of rasters that have no place, and of small reliefs

ROWS, COLUMNS = 40, 30
UTM = from_origin(462800, 5655800, 10, 10)
PLACE_TAGS = {33550, 33922, 34264, 34735, 34736, 34737, 42113}


def hills(rows=ROWS, columns=COLUMNS):
    y, x = np.mgrid[:rows, :columns]
    return (100 + 20 * np.sin(x / 5.0) * np.cos(y / 4.0)).astype(np.float32)


def write(path, heights=None, **profile):
    heights = hills() if heights is None else heights
    options = {"driver": "GTiff", "count": 1, "dtype": heights.dtype, "crs": "EPSG:32631", "transform": UTM}
    options.update(profile, height=heights.shape[0], width=heights.shape[1])
    tags = options.pop("tags", {})
    with rasterio.open(path, "w", **options) as raster:
        raster.write(heights, 1)
        raster.update_tags(**tags)
    return path


def place_tags(path):
    """Tags of the first directory that place it, as their bytes; of a classic TIFF, little-endian."""
    data = path.read_bytes()
    assert data[:4] == b"II*\0"
    (directory,) = struct.unpack_from("<I", data, 4)
    (count,) = struct.unpack_from("<H", data, directory)
    sizes = {2: 1, 3: 2, 12: 8}
    tags = {}
    for at in range(directory + 2, directory + 2 + 12 * count, 12):
        number, kind, length, offset = struct.unpack_from("<HHII", data, at)
        if number in PLACE_TAGS:
            size = length * sizes[kind]
            begin = offset if size > 4 else at + 8
            tags[number] = (kind, data[begin : begin + size])
    return tags


def fault(tmp_path, *arguments):
    """What the command says of a file that it does not take."""
    program = os.environ.get("HEIGHTLIGHT_COMMAND") or pytest.skip("HEIGHTLIGHT_COMMAND names no program: NOT RUN")
    done = subprocess.run([program, *map(str, arguments)], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 1 and done.stderr.count("\n") == 1
    assert not (tmp_path / "o").exists()
    return done.stderr


@pytest.mark.parametrize(
    "profile",
    [
        {},
        {"nodata": -9999.0, "tiled": True, "blockxsize": 16, "blockysize": 16, "compress": "deflate"},
        {"nodata": float("nan")},
        {"tags": {"AREA_OR_POINT": "Point"}},
        {"crs": "EPSG:2154", "nodata": -3.4028234663852886e38},
        {"crs": "+proj=laea +lat_0=52 +lon_0=10 +ellps=GRS80 +units=m"},
        {"crs": None},
    ],
)
def test_bake_keeps_place_crs_and_no_data(command, tmp_path, profile):
    heights = hills()
    nodata = profile.get("nodata")
    if nodata is not None:
        heights[5:8, 6] = nodata
    write(tmp_path / "dem.tif", heights, **profile)
    command("bake", "dem.tif", "--maps", "ao,horizon", "-o", "o", "--quiet")
    with rasterio.open(tmp_path / "dem.tif") as before, rasterio.open(tmp_path / "o/dem_ao.tif") as after:
        assert after.crs == before.crs
        assert after.transform == before.transform
        assert after.tags().get("AREA_OR_POINT") == before.tags().get("AREA_OR_POINT")
        assert after.dtypes == ("float32",) and after.block_shapes == [(256, 256)]
        assert after.compression.name == "deflate"
        assert after.nodata == nodata or np.isnan(nodata)
        expected = hl.sky(hl.Heightmap(hl.read(tmp_path / "dem.tif").height, 10, "open"), error=2e-3).sky_view_factor
        np.testing.assert_array_equal(after.read(1, masked=True).filled(np.nan), expected)
    assert place_tags(tmp_path / "o/dem_ao.tif") == place_tags(tmp_path / "dem.tif")
    assert place_tags(tmp_path / "o/dem_horizon.tif") == place_tags(tmp_path / "dem.tif")


def test_every_map_of_simulate_has_the_place(command, tmp_path):
    write(tmp_path / "dem.tif")
    command("simulate", "dem.tif", "-o", "o", "--bounces", 2, "--save-bounces", "--quiet")
    for name in ("ambient_occlusion", "sky_view_factor", "irradiance_total", "irradiance_00", "irradiance_02"):
        with rasterio.open(tmp_path / f"o/{name}.tif") as raster:
            assert raster.transform == UTM and raster.crs == "EPSG:32631"
            assert raster.descriptions[0]


def test_a_bigtiff_and_a_shrunk_one(command, tmp_path):
    write(tmp_path / "big.tif", BIGTIFF="YES")
    assert (tmp_path / "big.tif").read_bytes()[:4] == b"II+\0"
    command("bake", "big.tif", "--maps", "ao", "-o", "o", "--shrink", 2, "--quiet")
    with rasterio.open(tmp_path / "o/big_ao.tif") as raster:
        assert raster.transform == from_origin(462800, 5655800, 20, 20)
        assert raster.shape == (ROWS // 2, COLUMNS // 2)


def test_overviews_are_means(command, tmp_path):
    write(tmp_path / "dem.tif", hills(600, 500))
    command("bake", "dem.tif", "--maps", "ao", "-o", "o", "--quiet")
    with rasterio.open(tmp_path / "o/dem_ao.tif") as raster:
        assert raster.overviews(1) == [2, 4]
        full = raster.read(1)
    with rasterio.open(tmp_path / "o/dem_ao.tif", overview_level=0) as half:
        np.testing.assert_allclose(half.read(1), full.reshape(300, 2, 250, 2).mean((1, 3)), rtol=1e-6)


def test_degrees_become_metres(command, tmp_path):
    step = 1 / 3600
    write(tmp_path / "dem.tif", crs="EPSG:4326", transform=from_origin(7, 46, step, step))
    command("bake", "dem.tif", "--maps", "ao", "-o", "o", "--quiet")
    with rasterio.open(tmp_path / "o/dem_ao.tif") as raster:
        assert raster.crs == "EPSG:4326" and raster.transform == from_origin(7, 46, step, step)
    spacing = hl.read(tmp_path / "dem.tif").texel
    latitude = np.radians(46 - ROWS / 2 * step)
    a, f = 6378137.0, 1 / 298.257223563  # WGS 84
    e2 = f * (2 - f)
    s2 = np.sin(latitude) ** 2
    east = a * np.cos(latitude) / np.sqrt(1 - e2 * s2) * np.radians(step)
    north = a * (1 - e2) / (1 - e2 * s2) ** 1.5 * np.radians(step)
    np.testing.assert_allclose(spacing, (east, north), rtol=1e-5)  # of a series that is good to a centimetre in a degree


def test_heights_and_spacing_in_feet(tmp_path):
    foot = "+proj=utm +zone=31 +ellps=WGS84 +units=us-ft"
    write(tmp_path / "feet.tif", crs=foot)
    with pytest.raises(OSError, match="does not tell the unit of its heights"):
        hl.read(tmp_path / "feet.tif")
    with rasterio.open(tmp_path / "feet.tif", "r+") as raster:
        raster.units = ("us-ft",)
    np.testing.assert_allclose(hl.read(tmp_path / "feet.tif").texel, (10, 10), rtol=1e-12)
    with rasterio.open(tmp_path / "feet.tif", "r+") as raster:
        raster.units = ("m",)
    np.testing.assert_allclose(hl.read(tmp_path / "feet.tif").texel, (12000 / 3937,) * 2, rtol=1e-12)


def test_integers_with_a_pixel_scale_are_terrain(tmp_path):
    write(tmp_path / "dem.tif", hills().astype(np.int16), nodata=-32768)
    read = hl.read(tmp_path / "dem.tif")
    assert read.boundary == "open" and not read.facts["stretched"]
    assert read.base == hills().astype(np.int16).min()


@pytest.mark.parametrize("nodata", [0.0, 1.0])
@pytest.mark.parametrize("form", ["tif", "asc"])
def test_no_data_is_nothing_but_missing(command, tmp_path, nodata, form):
    heights = hills()
    heights[3, 4] = nodata
    write(tmp_path / "dem.tif", heights, nodata=nodata)
    command("bake", "dem.tif", "--maps", "ao", "-o", "o", "--format", form, "--quiet")
    with rasterio.open(tmp_path / f"o/dem_ao.{form}") as raster:
        assert raster.nodata == nodata
        assert np.array_equal(np.argwhere(raster.read_masks(1) == 0), [[3, 4]])


def test_no_data_beyond_floats_becomes_the_lowest(command, tmp_path):
    heights = hills().astype(np.float64)
    heights[3, 4] = np.finfo(np.float64).min
    write(tmp_path / "dem.tif", heights, nodata=np.finfo(np.float64).min)
    command("bake", "dem.tif", "--maps", "ao", "-o", "o", "--quiet")
    with rasterio.open(tmp_path / "o/dem_ao.tif") as raster:
        assert raster.nodata == np.finfo(np.float32).min
        assert np.array_equal(np.argwhere(raster.read_masks(1) == 0), [[3, 4]])


def test_no_data_that_is_no_number_is_left_out(command, tmp_path):
    write(tmp_path / "dem.tif", nodata=-99999.0)
    data = (tmp_path / "dem.tif").read_bytes()
    assert data.count(b"-99999\0") == 1
    (tmp_path / "dem.tif").write_bytes(data.replace(b"-99999\0", b"absent\0"))
    for form in ("tif", "asc"):
        command("bake", "dem.tif", "--maps", "ao", "-o", form, "--format", form, "--quiet")
    with rasterio.open(tmp_path / "tif/dem_ao.tif") as raster:
        assert raster.nodata is None
    with rasterio.open(tmp_path / "asc/dem_ao.asc") as raster:
        assert raster.nodata == -9999


def test_scale_and_offset_of_the_metadata_are_applied(tmp_path):
    stored = np.round(hills() * 10).astype(np.int16)
    write(tmp_path / "dem.tif", stored, nodata=-32768)
    with rasterio.open(tmp_path / "dem.tif", "r+") as raster:
        raster.scales, raster.offsets = (0.1,), (3,)
    with pytest.warns(Warning, match="0.1 times its samples, plus 3"):
        read = hl.read(tmp_path / "dem.tif")
    np.testing.assert_allclose(read.height + read.base, stored * 0.1 + 3, rtol=1e-6)
    own = hl.read(tmp_path / "dem.tif", scale=2)
    np.testing.assert_allclose(own.height + own.base, stored * 2.0, rtol=1e-6)
    with rasterio.open(tmp_path / "dem.tif", "r+") as raster:
        raster.scales = (-1,)
    with pytest.raises(OSError, match="give a positive scale"):
        hl.read(tmp_path / "dem.tif")


def test_a_mask_is_told_of(tmp_path):
    with rasterio.Env(GDAL_TIFF_INTERNAL_MASK="YES"):
        write(tmp_path / "dem.tif")
        with rasterio.open(tmp_path / "dem.tif", "r+") as raster:
            raster.write_mask(np.arange(ROWS * COLUMNS).reshape(ROWS, COLUMNS) > 5)
    with pytest.warns(Warning, match="a mask of missing samples, which is not read"):
        hl.read(tmp_path / "dem.tif")


def test_degrees_of_the_moon_are_not_the_earths(tmp_path):
    moon = "+proj=longlat +a=1737400 +b=1737400 +no_defs"
    write(tmp_path / "dem.tif", crs=moon, transform=from_origin(7, 46, 0.01, 0.01))
    with pytest.raises(OSError, match="degrees of a body that is not the Earth"):
        hl.read(tmp_path / "dem.tif")
    assert hl.read(tmp_path / "dem.tif", texel=210).texel == (210, 210)


def test_samples_on_the_pole(tmp_path):
    write(tmp_path / "dem.tif", crs="EPSG:4326", transform=from_origin(0, 90.05, 0.1, 0.1))
    with pytest.warns(Warning, match="from north to south they widen from 0 to"):
        hl.read(tmp_path / "dem.tif")


GRID = "ncols 30\nnrows 40\nxllcorner 462800\nyllcorner 5655400\ncellsize 10\nNODATA_value -999\n"


@pytest.mark.parametrize("crs", ["EPSG:32631", "EPSG:2154", "+proj=laea +lat_0=52 +lon_0=10 +ellps=GRS80 +units=m"])
def test_an_esri_grid_passes_its_projection_along(command, tmp_path, crs):
    heights = hills()
    heights[3, 4] = -999
    (tmp_path / "dem.asc").write_text(GRID + "\n".join(" ".join(map(str, row)) for row in heights) + "\n")
    text = rasterio.crs.CRS.from_user_input(crs).to_wkt(version="WKT1_ESRI")
    (tmp_path / "dem.prj").write_text(text + "\n")
    command("bake", "dem.asc", "--maps", "ao,horizon", "-o", "o", "--quiet")
    command("bake", "dem.asc", "--maps", "ao,horizon", "-o", "o", "--format", "asc", "--quiet")
    assert (tmp_path / "o/dem_ao.prj").read_text().strip() == text
    assert (tmp_path / "o/dem_horizon-3.prj").exists()
    with rasterio.open(tmp_path / "dem.asc") as before:
        for name in ("dem_ao.tif", "dem_ao.asc"):
            with rasterio.open(tmp_path / "o" / name) as after:
                assert after.transform == before.transform and after.nodata == -999
                assert after.crs == before.crs
                assert hl.read(tmp_path / "o" / name).texel == (10, 10)
    with rasterio.open(tmp_path / "o/dem_ao.tif") as tif, rasterio.open(tmp_path / "o/dem_ao.asc") as text_grid:
        np.testing.assert_array_equal(tif.read(1), text_grid.read(1).astype(np.float32))


def test_a_projection_in_keywords_keeps_its_lines(command, tmp_path):
    (tmp_path / "dem.asc").write_text(GRID + "\n".join(" ".join(map(str, row)) for row in hills()) + "\n")
    text = "Projection    UTM\nZone          31\nDatum         WGS84\nZunits        NO\nUnits         METERS\nParameters\n"
    (tmp_path / "dem.prj").write_text(text)
    for form in ("tif", "asc"):
        command("bake", "dem.asc", "--maps", "ao", "-o", "o", "--format", form, "--quiet")
        with rasterio.open(tmp_path / "dem.asc") as before, rasterio.open(tmp_path / f"o/dem_ao.{form}") as after:
            assert after.crs == before.crs == "EPSG:32631"
    assert (tmp_path / "o/dem_ao.prj").read_text() == text


def test_a_grid_without_a_projection_names_none(command, tmp_path):
    (tmp_path / "dem.asc").write_text(GRID + "\n".join(" ".join(map(str, row)) for row in hills()) + "\n")
    command("bake", "dem.asc", "--maps", "ao", "-o", "o", "--quiet")
    with rasterio.open(tmp_path / "o/dem_ao.tif") as raster:
        assert raster.crs is None and raster.transform == from_origin(462800, 5655800, 10, 10)


def test_an_srtm_tile(command, tmp_path):
    tile = np.full((1201, 1201), 500, ">i2")
    tile[::50] += 100
    tile[7, 9] = -32768
    (tmp_path / "N45E006.hgt").write_bytes(tile.tobytes())
    command("bake", "N45E006.hgt", "--maps", "ao", "-o", "o", "--error", 0.02, "--quiet")
    with rasterio.open(tmp_path / "N45E006.hgt") as before, rasterio.open(tmp_path / "o/N45E006_ao.tif") as after:
        np.testing.assert_allclose(after.transform, before.transform, rtol=0, atol=1e-12)
        assert after.crs == before.crs == "EPSG:4326"
        assert after.nodata == before.nodata == -32768
        assert np.array_equal(np.argwhere(after.read(1) == -32768), [[7, 9]])


def gcp(row, col, x, y):
    return GroundControlPoint(row=row, col=col, x=x, y=y)


def test_odd_and_contradictory_places_are_refused(tmp_path):
    dem = tmp_path / "dem.tif"
    write(dem, transform=UTM * Affine.rotation(10))
    assert "rotated or sheared" in fault(tmp_path, "bake", dem, "-o", "o")
    write(dem, transform=Affine(10, 0, 462800, 0, 10, 5655400))
    assert "from south to north" in fault(tmp_path, "bake", dem, "-o", "o")
    points = [gcp(0, 0, 4e5, 5e6), gcp(0, 30, 4.1e5, 5e6), gcp(40, 0, 4e5, 4.9e6), gcp(40, 30, 4.1e5, 4.9e6)]
    write(dem, transform=None, gcps=points)
    assert "control points" in fault(tmp_path, "bake", dem, "-o", "o")
    write(dem, crs="EPSG:4326", transform=from_origin(7, 460, 0.1, 0.1))
    assert "beyond the poles" in fault(tmp_path, "simulate", dem, "-o", "o")


def test_a_spacing_of_ones_own_needs_no_place(command, tmp_path):
    write(tmp_path / "dem.tif", transform=UTM * Affine.rotation(10))
    command("bake", "dem.tif", "--texel", 10, "--boundary", "open", "--maps", "ao", "-o", "o", "--quiet")
    with rasterio.open(tmp_path / "o/dem_ao.tif") as raster:
        assert raster.crs is None  # the place was left out, and a line said so


def test_info_says_which_and_why(tmp_path):
    program = os.environ.get("HEIGHTLIGHT_COMMAND") or pytest.skip("HEIGHTLIGHT_COMMAND names no program: NOT RUN")
    said = lambda path: subprocess.run([program, "info", path], capture_output=True, text=True, check=True).stdout
    terrain = said(write(tmp_path / "dem.tif"))
    assert "terrain: its file gives the distance between samples, 10 x 10 m" in terrain
    assert "462800, 5655800 in EPSG:32631" in terrain
    assert "material: its file gives no distance" in said(write(tmp_path / "plain.tif", crs=None, transform=None))
