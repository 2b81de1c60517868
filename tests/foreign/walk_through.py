"""Chromium draws the page that `export` writes: its picture is the one that `render` draws, and a click tells what `probe` tells.

    walk_through.py PENUMBRA CHROMEDRIVER SCRATCH
"""

import io
import pathlib
import subprocess
import sys

import matplotlib.image
import numpy

from browser import Browser

program, chromedriver, scratch = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
scratch.mkdir(parents=True, exist_ok=True)
WIDTH, HEIGHT = 640, 480
SIZE = f"size={WIDTH}x{HEIGHT}&interface=0"
CAMERAS = {"office": ["room", "above", "desk"], "cornell": ["published", "blocks", "ceiling"]}
CODES = 2  # of 255: a pixel may differ by this; the two round gradients and depths in different ways
SMOOTH = 2  # codes: where the reference varies by more among the neighbours of a pixel, there is an edge
LEAST_COMPARED = 0.5  # of all pixels: the steep gradients at cornell's lamp are edges by this measure


def run(*arguments):
    return subprocess.run([program, *arguments], cwd=scratch, check=True, capture_output=True, text=True).stdout


def demand(condition, what):
    if not condition:
        sys.exit("failed: " + what)


def codes(png):
    return numpy.rint(255 * matplotlib.image.imread(io.BytesIO(png), format="png")[:, :, :3]).astype(int)


def smooth(picture):
    """Which pixels have neighbours that agree; those at the picture's border have not all of theirs."""
    windows = numpy.lib.stride_tricks.sliding_window_view(picture, (3, 3), axis=(0, 1))
    inside = (windows.max(axis=(3, 4)) - windows.min(axis=(3, 4))).max(axis=2) <= SMOOTH
    return numpy.pad(inside, 1)


def compare(name, reference, shown, counts):
    demand(shown.shape == reference.shape, f"{name}: the size of the picture")
    difference = abs(reference - shown).max(axis=2)
    print(f"{name}: {counts.mean():.3f} of the pixels compared, largest difference {difference[counts].max()} of 255, "
          f"mean {difference[counts].mean():.3f}")
    demand(counts.mean() > LEAST_COMPARED, f"{name}: most pixels are compared")
    demand(difference[counts].max() <= CODES, f"{name}: the pixels of render")


def compare_cameras(browser, scene):
    for camera in CAMERAS[scene]:
        # Without an exposure both meter the picture, by the same rule.
        run("render", f"{scene}.h5", "-o", "reference.png", "--camera", camera, "--size", f"{WIDTH}x{HEIGHT}",
            "--supersampling", "1")
        reference = codes((scratch / "reference.png").read_bytes())
        browser.open(scratch / f"{scene}.html", f"camera={camera}&{SIZE}")
        browser.after_frames()
        compare(f"{scene} {camera}", reference, codes(browser.picture_of("#picture")), smooth(reference))


def compare_false_colours(browser):
    """The scale of render's picture covers its lower right corner."""
    run("render", "office.h5", "-o", "reference.png", "--size", f"{WIDTH}x{HEIGHT}", "--false-colour", "--exposure", "0.04")
    reference = codes((scratch / "reference.png").read_bytes())
    browser.open(scratch / "office.html", f"{SIZE}&show=radiosity&exposure=0.04")
    browser.after_frames()
    counts = smooth(reference)
    counts[HEIGHT - 160:, WIDTH - 120:] = False
    compare("office in false colours", reference, codes(browser.picture_of("#picture")), counts)


def compare_probe(browser):
    """A click in the middle of the picture measures where the camera looks; `probe` measures at the point that it tells."""
    browser.open(scratch / "office.html", f"{SIZE}&eye=2,1.8,1.6&look-at=1.7,2.6,0.72&fov=50")
    browser.after_frames()
    browser.pointer(("move", WIDTH // 2, HEIGHT // 2), ("down",), ("up",))
    told = browser.run("return page.measured")
    demand(told is not None, "a click measures")
    (scratch / "points.csv").write_text("x,y,z,nx,ny,nz\n" + ",".join(map(repr, told["point"])) + ",0,0,1\n")
    row = run("probe", "office.h5", "--points", "points.csv").splitlines()[1].split(",")
    interpolated = numpy.array(row[10:13], float)
    print("probe", interpolated, "the page", told["light"]["irradiance"], "on", told["light"]["material"])
    demand(int(row[6]) == told["light"]["patch"], "the number of the face")
    demand(numpy.allclose(told["light"]["irradiance"], interpolated, rtol=1e-4), "irradiance by click")
    table = browser.run("return document.getElementById('probe').innerText")
    demand(told["light"]["material"] in table and "W/m²" in table, "the table of the measurement")


def use_controls(browser):
    """Keys walk and change the picture; dragging turns about the point in the middle; the address leads back."""
    browser.open(scratch / "cornell.html", SIZE)
    browser.after_frames()
    demand(browser.run("return page.settings.mesh") is False, "lines are off")
    browser.keys("t")
    browser.keys("x")
    browser.keys("o")
    demand(browser.run("return [page.settings.mesh, page.settings.discontinuities, page.settings.show]")
           == [True, True, "radiosity"], "keys")
    eye, target = browser.run("return [page.camera.eye, page.camera.lookAt]")
    browser.pointer(("move", 300, 200), ("down",), ("move", 340, 210), ("move", 380, 220), ("up",))
    turned_eye, turned_target = browser.run("return [page.camera.eye, page.camera.lookAt]")
    demand(turned_target == target and turned_eye != eye, "dragging turns")
    radius = [numpy.linalg.norm(numpy.subtract(a, target)) for a in (eye, turned_eye)]
    demand(abs(radius[1] / radius[0] - 1) < 1e-9, "a turn keeps the distance")
    demand(browser.run("return page.measured") is None, "dragging measures nothing")
    state = "return [page.camera.eye.concat(page.camera.lookAt, page.camera.fov, page.settings.exposure), page.settings.show]"
    numbers, show = browser.run(state)
    browser.run("page.link(); const fragment = location.hash; page.home();"
                "history.replaceState(null, '', fragment + '&" + SIZE + "'); page.obeyAddress();")
    again, shown = browser.run(state)
    demand(numpy.allclose(numbers, again, rtol=1e-3, atol=1e-6) and show == shown, "the link leads back to the view")
    for key in "wq":
        browser.keys(key)
    demand(browser.run("return page.controls.pressed.size") == 0, "keys come up again")


for scene, error in ("office", "0.05"), ("cornell", "0.05"):
    run("solve", scene, "--error", error, "-o", f"{scene}.h5")
    run("export", f"{scene}.h5", "-o", f"{scene}.html")
with Browser(chromedriver, scratch) as browser:
    for scene in CAMERAS:
        compare_cameras(browser, scene)
        fps = browser.run("return page.renderer.benchmark(page.camera, page.settings, 5)")
        print(f"{scene}.html: {(scratch / f'{scene}.html').stat().st_size} bytes, {fps:.1f} frames a second")
    compare_false_colours(browser)
    compare_probe(browser)
    use_controls(browser)
    demand(browser.complaints() == [], "the page has no complaints")
