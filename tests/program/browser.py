# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Chromium without a window, which draws by software: what pages look like,
what the browser reports about them, and what they load."""

import io
import json
import time

import matplotlib.image
import numpy as np
from selenium import webdriver
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

ARGUMENTS = ("--headless=new", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-dev-shm-usage", "--hide-scrollbars",
             "--disable-background-networking", "--force-device-scale-factor=1")


class Browser:

    def __init__(self):
        options = webdriver.ChromeOptions()
        options.binary_location = "/usr/bin/chromium"
        for argument in ARGUMENTS:
            options.add_argument(argument)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        self.driver = webdriver.Chrome(options=options, service=webdriver.ChromeService("/usr/bin/chromedriver"))

    def quit(self):
        self.driver.quit()

    def set_size(self, width, height):
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False})

    def set_media(self, **features):
        """Sets media features, for example prefers_color_scheme="dark"."""
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia",
                                    {"features": [{"name": name.replace("_", "-"), "value": value} for name, value in features.items()]})

    def open(self, path):
        """Opens a page and waits until its data are read and it is drawn.
        Returns how long reading took [s]."""
        self.driver.get_log("browser"), self.driver.get_log("performance")
        start = time.monotonic()
        self.driver.get(path.as_uri())
        while self.run("return document.documentElement.dataset.ready") != "true":
            if time.monotonic() - start > 30:
                raise AssertionError(f"{path} does not get ready: {self.messages()}")
            time.sleep(0.02)
        seconds = time.monotonic() - start
        self.settle()
        return seconds

    def run(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def settle(self):
        """Waits until the requested state is drawn."""
        self.driver.execute_async_script("const done = arguments[0]; requestAnimationFrame(() => requestAnimationFrame(() => done()))")

    def messages(self):
        """The messages in the console since the page was opened."""
        return [entry["message"] for entry in self.driver.get_log("browser")]

    def requests(self):
        """The addresses that the page has loaded, without its own."""
        events = [json.loads(entry["message"])["message"] for entry in self.driver.get_log("performance")]
        sent = [event["params"]["request"]["url"] for event in events if event["method"] == "Network.requestWillBeSent"]
        return [url for url in sent if url != self.driver.current_url and not url.startswith(("data:", "blob:"))]

    def find(self, selector):
        return self.driver.find_element(By.CSS_SELECTOR, selector)

    def texts(self, selector):
        return self.run("return [...document.querySelectorAll(arguments[0])].map((one) => one.textContent)", selector)

    def data(self):
        """The numbers of the page by their names: the stored number and the
        text that is shown."""
        found = self.run("return [...document.querySelectorAll('data[data-key]')].map((one) => [one.dataset.key, one.value, one.textContent])")
        return {key: (value, text) for key, value, text in found}

    def press(self, *keys, shift=False, settled=True):
        """Presses keys; the focused element gets them."""
        chain = ActionChains(self.driver)
        if shift:
            chain.key_down(Keys.SHIFT)
        for key in keys:
            chain.send_keys(key)
        if shift:
            chain.key_up(Keys.SHIFT)
        chain.perform()
        if settled:
            self.settle()

    def set_value(self, name, value):
        """Sets the value of an input or a choice with the events that a person
        causes."""
        self.run("const e = document.getElementById(arguments[0]); e.value = arguments[1];"
                 "for (const type of ['input', 'change']) e.dispatchEvent(new Event(type, {bubbles: true}))", name, str(value))
        self.settle()

    def click(self, selector):
        self.run("document.querySelector(arguments[0]).click()", selector)
        self.settle()

    def point_at(self, x, y):
        """Moves the mouse to a position in the window [pixels]."""
        chain = ActionChains(self.driver)
        chain.w3c_actions.pointer_action.move_to_location(int(x), int(y))
        chain.perform()
        self.settle()

    def press_mouse(self):
        """Presses the mouse button at its position."""
        ActionChains(self.driver).click().perform()
        self.settle()

    def picture(self, selector):
        """The pixels of an element as numbers from 0 to 255 (rows x columns x
        3), without elements that lie over it, whose texts change."""
        others = "for (const one of document.querySelector(arguments[0]).parentElement.children) if (!one.matches(arguments[0]))"
        self.run(others + "one.style.visibility = 'hidden'", selector)
        self.settle()
        png = self.find(selector).screenshot_as_png
        self.run(others + "one.style.visibility = ''", selector)
        return np.round(255 * matplotlib.image.imread(io.BytesIO(png))[:, :, :3]).astype(int)


def n_different(one, other):
    """The number of pixels whose colours differ by more than antialiasing may
    cause."""
    return int((abs(one - other).max(axis=2) > 8).sum())
