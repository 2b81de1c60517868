"""Chromium without a window, driven by the WebDriver protocol, which needs nothing but the standard library.

    with Browser(chromedriver, scratch) as browser:
        browser.open(path, "size=640x480")
"""

import base64
import json
import pathlib
import re
import subprocess
import tempfile
import time
import urllib.request

ELEMENT = "element-6066-11e4-a52e-4f735466cecf"  # the protocol's name for a reference to an element
ARGUMENTS = ["--headless=new", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
             "--disable-background-networking", "--disable-component-update", "--disable-sync", "--no-first-run",
             "--disable-default-apps", "--disable-dev-shm-usage", "--force-color-profile=srgb",
             "--force-device-scale-factor=1", "--window-size=1400,1100"]


class Browser:
    def __init__(self, chromedriver, scratch):
        # A profile of its own, and a home of its own: nothing that the user has is touched.
        self.folder = tempfile.TemporaryDirectory(dir=scratch)
        self.log = pathlib.Path(scratch) / "chromedriver.log"
        environment = {"HOME": self.folder.name, "PATH": "/usr/bin:/bin", "LANG": "C.UTF-8"}
        self.driver = subprocess.Popen([chromedriver, "--port=0"], stdout=open(self.log, "w"), stderr=subprocess.STDOUT,
                                       env=environment)
        port = self.wait_for(lambda: re.search(r"on port (\d+)\.", self.log.read_text()), "the driver to start").group(1)
        self.session = f"http://127.0.0.1:{port}/session"
        options = {"args": ARGUMENTS + [f"--user-data-dir={self.folder.name}/profile"]}
        wanted = {"browserName": "chrome", "goog:chromeOptions": options, "goog:loggingPrefs": {"browser": "ALL"}}
        started = self.call("", {"capabilities": {"alwaysMatch": wanted}})
        self.session += "/" + started["sessionId"]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        try:
            self.call("", method="DELETE")
        finally:
            self.driver.terminate()
            self.driver.wait(10)
            self.folder.cleanup()

    def call(self, path, body=None, method=None):
        data = None if body is None else json.dumps(body).encode()
        request = urllib.request.Request(self.session + path, data, {"Content-Type": "application/json"}, method=method)
        opener = urllib.request.build_opener(urllib.request.ProxyHandler({}))
        try:
            with opener.open(request, timeout=120) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as error:
            raise RuntimeError(error.read().decode()) from error

    @staticmethod
    def wait_for(condition, what, seconds=60):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            found = condition()
            if found:
                return found
            time.sleep(0.05)
        raise RuntimeError("waited in vain for " + what)

    def open(self, path, fragment=""):
        self.call("/url", {"url": pathlib.Path(path).absolute().as_uri() + "#" + fragment})

    def run(self, script, *arguments):
        """What the body of a function returns in the page."""
        return self.call("/execute/sync", {"script": script, "args": list(arguments)})

    def after_frames(self):
        """Waits until what was asked for is on the screen."""
        self.call("/execute/async", {"script": "const done = arguments[0];"
                                               "requestAnimationFrame(() => requestAnimationFrame(() => done()));", "args": []})

    def element(self, selector):
        return self.call("/element", {"using": "css selector", "value": selector})[ELEMENT]

    def picture_of(self, selector):
        """The PNG of an element, as it is on the screen."""
        return base64.b64decode(self.call(f"/element/{self.element(selector)}/screenshot"))

    def screen(self):
        return base64.b64decode(self.call("/screenshot"))

    def pointer(self, *steps):
        """Moves the mouse: ("move", x, y), ("down",), ("up",)."""
        kinds = {"move": "pointerMove", "down": "pointerDown", "up": "pointerUp"}
        actions = []
        for kind, *place in steps:
            action = {"type": kinds[kind], "button": 0}
            if place:
                action.update(x=place[0], y=place[1], duration=50)
            actions.append(action)
        self.call("/actions", {"actions": [{"type": "pointer", "id": "mouse", "actions": actions}]})

    def keys(self, text):
        actions = [{"type": kind, "value": key} for key in text for kind in ("keyDown", "keyUp")]
        self.call("/actions", {"actions": [{"type": "key", "id": "keyboard", "actions": actions}]})

    def complaints(self):
        """What the page wrote on its console, from warnings on."""
        return [entry["message"] for entry in self.call("/se/log", {"type": "browser"})
                if entry["level"] in ("WARNING", "SEVERE")]
