"""Opens reports of the command in Debian's Chromium, as a reader does: no errors in the console, nothing loaded, tabs
that flip at the same place, and the values of the EXR under the pointer. Exits with 77 where there is no browser.

    chromium_report.py HEIGHTLIGHT
"""

import json
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import urllib.parse
import zlib

try:
    import numpy
    from selenium import webdriver
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
except ImportError as missing:
    print(f"SKIPPED: {missing} (scripts/install-packages --tests)")
    sys.exit(77)

HOSTILE = "<b>&\"'\n<script>"  # of a file: a slash cannot be in a name


def read_exr(path):
    """The channels of a scanline EXR of floats, uncompressed or by zip: name → rows."""
    with open(path, "rb") as file:
        data = file.read()
    place = 8
    header = {}
    while data[place]:
        name, kind, rest = data[place:].split(b"\0", 2)
        place += len(name) + len(kind) + 2
        (size,) = struct.unpack_from("<i", data, place)
        header[name] = data[place + 4 : place + 4 + size]
        place += 4 + size
    place += 1
    names = re.findall(rb"([^\0]+)\0\x02\0\0\0.{12}", header[b"channels"], re.DOTALL)
    left, top, right, bottom = struct.unpack("<4i", header[b"dataWindow"])
    columns, rows = right - left + 1, bottom - top + 1
    strip = {0: 1, 2: 1, 3: 16}[header[b"compression"][0]]
    values = numpy.zeros((rows, len(names), columns), "<f4")
    for first in range(0, rows, strip):
        (chunk,) = struct.unpack_from("<q", data, place + 8 * (first // strip))
        (size,) = struct.unpack_from("<i", data, chunk + 4)
        packed = data[chunk + 8 : chunk + 8 + size]
        count = min(strip, rows - first)
        if size < 4 * count * len(names) * columns:
            steps = numpy.frombuffer(zlib.decompress(packed), "u1").astype(int)
            steps[1:] -= 128
            halves = numpy.cumsum(steps).astype("u1")
            middle = (len(halves) + 1) // 2
            whole = numpy.empty_like(halves)
            whole[0::2], whole[1::2] = halves[:middle], halves[middle:]
            packed = whole.tobytes()
        values[first : first + count] = numpy.frombuffer(packed, "<f4").reshape(count, len(names), columns)
    return {name.decode(): values[:, i] for i, name in enumerate(names)}


class Reader:
    """A browser that opens reports and watches what they do."""

    def __init__(self):
        options = webdriver.ChromeOptions()
        options.binary_location = shutil.which("chromium")
        for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage"):
            options.add_argument(argument)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        service = webdriver.chrome.service.Service(shutil.which("chromedriver"))
        self.driver = webdriver.Chrome(options=options, service=service)

    def open(self, path, width=1400):
        self.driver.execute_cdp_cmd(
            "Emulation.setDeviceMetricsOverride",
            {"width": width, "height": 1000, "deviceScaleFactor": 1, "mobile": False},
        )
        self.driver.get("file://" + urllib.parse.quote(os.path.abspath(path)))
        for _ in range(600):
            if self.run("return document.documentElement.dataset.ready") == "yes":
                break
            time.sleep(0.1)
        assert self.run("return document.documentElement.dataset.ready") == "yes", "the page is never ready"
        self.check_quiet(path)
        assert self.run("return document.documentElement.scrollWidth") <= width, "wider than the window"

    def check_quiet(self, path):
        """Nothing in the console, and nothing asked for but the file itself."""
        said = self.driver.get_log("browser")
        assert not said, said
        for entry in self.driver.get_log("performance"):
            message = json.loads(entry["message"])["message"]
            if message["method"] == "Network.requestWillBeSent":
                url = message["params"]["request"]["url"]
                assert url.startswith("file://") and os.path.samefile(urllib.parse.unquote(url[7:]), path), url

    def run(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def all(self, selector, within=None):
        return (within or self.driver).find_elements(By.CSS_SELECTOR, selector)

    def one(self, selector, within=None):
        return (within or self.driver).find_element(By.CSS_SELECTOR, selector)

    def point(self, canvas, share_x, share_y):
        """The pointer to a place of an element, in shares of its size from its middle."""
        self.run("arguments[0].scrollIntoView({block: 'center'})", canvas)
        size = canvas.size
        ActionChains(self.driver, duration=0).move_to_element_with_offset(
            canvas, int(share_x * size["width"]), int(share_y * size["height"])
        ).perform()

    def press(self, *keys):
        ActionChains(self.driver, duration=0).send_keys(*keys).perform()

    def readout(self, section):
        output = self.one("output", section)
        data = self.run("return {...arguments[0].dataset}", output)
        return int(data["column"]), int(data["row"]), [float(value) for value in data["value"].split(",")], output.text

    def chosen(self, section):
        return [tab.text for tab in self.all("[role=tab]", section) if tab.get_attribute("aria-selected") == "true"]


def decimals_of(section, reader):
    step = re.search(r"values rounded to ([0-9.]+)\.", reader.one(".about", section).text).group(1)
    return len(step.split(".")[1]) if "." in step else 0


def check_readout(reader, section, exr, share):
    """What is read at a place is the EXR's value there, rounded as the page says, in the text, too."""
    reader.point(reader.one("canvas", section), *share)
    column, row, values, text = reader.readout(section)
    decimals = decimals_of(section, reader)
    for channel, value in zip(sorted(exr, key="YRGB".index), values):
        expected = float(exr[channel][row, column])
        assert abs(value - expected) <= 0.5 * 10**-decimals + 1e-9, (channel, value, expected)
        assert f"{value:.{decimals}f}" in text, (value, text)
    assert f"column {column}, row {row}" in text, text
    return column, row


def check_simulation(reader, folder):
    page = os.path.join(folder, "report.html")
    reader.open(page)
    assert HOSTILE.replace("\n", "?") in reader.one("h1").text, reader.one("h1").text
    command = reader.one("#command").text
    assert command.startswith("heightlight simulate $'<b>&\"\\'\\n<script>.exr'"), command
    assert not reader.all("b:not(.legend b)"), "a name became an element"

    section = reader.one("section.pictures")
    exr = read_exr(os.path.join(folder, "sky_view_factor.exr"))
    assert len({check_readout(reader, section, exr, share) for share in ((0, 0), (0.1, -0.2), (-0.12, 0.05))}) == 3

    total = next(tab for tab in reader.all("[role=tab]", section) if "total" in tab.text)
    total.click()
    assert reader.chosen(section) == [total.text]
    exr = read_exr(os.path.join(folder, "irradiance_total.exr"))
    assert len(exr) == 3
    place = check_readout(reader, section, exr, (0.07, 0.11))

    # Tabs flip by arrows and digits, at the same place.
    first = reader.all("[role=tab]", section)[0]
    first.click()
    reader.press(Keys.ARROW_RIGHT)
    assert reader.chosen(section)[0].startswith("2 ")
    assert reader.readout(section)[:2] == place
    reader.run("arguments[0].focus()", reader.one("canvas", section))
    reader.press("3")
    assert reader.chosen(section)[0].startswith("3 ")
    reader.press(" ")
    assert reader.chosen(section)[0].startswith("2 ")
    reader.press("+", "+")
    ActionChains(reader.driver).key_down(Keys.SHIFT).send_keys(Keys.ARROW_RIGHT).key_up(Keys.SHIFT).perform()
    assert reader.readout(section)[:2] == (place[0] + 1, place[1])

    chart = reader.one("section.chart")
    curves = len(reader.all("path", chart))
    button = reader.one(".legend button", chart)
    button.click()
    assert len(reader.all("path", chart)) == curves - 1
    assert button.get_attribute("aria-pressed") == "false"
    button.click()
    reader.point(reader.one("svg", chart), 0.1, 0)
    assert re.search("[0-9]", reader.one(".legend b", chart).text), "no value of the curve is told"

    table = reader.one("section.table")
    head = reader.all("th button", table)[1]
    for order in (1, -1):
        head.click()
        column = [float(cell.text) for cell in reader.all("tbody td:nth-child(2)", table)]
        assert column == sorted(column, reverse=order < 0), column
    reader.check_quiet(page)
    reader.open(page, width=400)


def check_comparison(reader, folder):
    reader.open(os.path.join(folder, "report.html"))
    section = reader.one("section.pictures")
    tabs = reader.all("[role=tab]", section)
    assert len(tabs) > 5
    reader.point(reader.one("canvas", section), 0.1, 0.1)
    place = reader.readout(section)[:2]
    truth = reader.readout(section)[2][0]
    reader.run("arguments[0].focus()", reader.one("canvas", section))
    for key in "234":
        reader.press(key)
        column, row, values, text = reader.readout(section)
        assert (column, row) == place
        error = float(re.search(r"error ([-+0-9.]+)", text).group(1))
        assert abs(error - (values[0] - truth)) <= 0.51e-4, text
    button = next(button for button in reader.all(".controls button", section) if button.text.startswith("Error"))
    button.click()
    assert "less reference" in reader.one(".scale", section).text
    reader.check_quiet(os.path.join(folder, "report.html"))
    reader.open(os.path.join(folder, "report.html"), width=400)


def main():
    heightlight = os.path.abspath(sys.argv[1])
    if not shutil.which("chromium") or not shutil.which("chromedriver"):
        print("SKIPPED: no chromium or no chromedriver (scripts/install-packages --tests)")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as folder:

        def run(*arguments):
            subprocess.run([heightlight, *arguments, "--quiet"], cwd=folder, check=True, stdin=subprocess.DEVNULL)

        subprocess.run([heightlight, "synth", "cobbles", "--size", "32", "-o", "map.exr"], cwd=folder, check=True)
        name = HOSTILE + ".exr"
        shutil.copy(os.path.join(folder, "map.exr"), os.path.join(folder, name))
        run("simulate", name, "-o", "simulated", "--relief", "0.1", "--albedo", "0.7,0.5,0.2", "--report")
        run("bake", name, "-o", "baked", "--maps", "ao,normal,ao-n", "--report")
        run("fit", "simulated/curves.csv", "-o", "fitted", "--bootstrap", "20", "--report")
        run("compare", "map.exr", "-o", "compared", "--relief", "0.1", "--albedo", "0.5", "--report")
        with open(os.path.join(folder, "study.json"), "w", encoding="utf-8") as study:
            json.dump({"maps": [{"file": name, "name": "one"}], "options": [{"bounces": 3}]}, study)
        run("dataset", "study.json", "-o", "dataset", "--report")
        reader = Reader()
        try:
            check_simulation(reader, os.path.join(folder, "simulated"))
            check_comparison(reader, os.path.join(folder, "compared"))
            for place in ("fitted", "dataset", "baked"):
                (page,) = [each for each in os.listdir(os.path.join(folder, place)) if each.endswith("report.html")]
                for width in (1400, 400):
                    reader.open(os.path.join(folder, place, page), width)
        finally:
            reader.driver.quit()


if __name__ == "__main__":
    main()
