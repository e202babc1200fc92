"""What several of the Python tests need: the program, and a browser."""

import importlib.util
import json
import os
import shutil
import socket
import subprocess
import sys


def one_thread_each():
    """The environment of a program that computes on one thread."""
    return dict(os.environ, OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1")


def run_program(program, *arguments):
    """Runs it to its end, which must be a good one. Returns what it prints."""
    result = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, env=one_thread_each(),
                            check=False, timeout=300)
    assert result.returncode == 0, result.stderr
    return result.stdout


def skip_without_browser():
    """Ends a test, as skipped, where open_browser() cannot work."""
    missing = [program for program in ("chromium", "chromedriver") if not shutil.which(program)]
    if not importlib.util.find_spec("selenium"):
        missing.append("python3-selenium")
    if missing:
        print("not installed:", *missing)
        sys.exit(77)


def open_browser(width, height):
    """Chromium without a window, which keeps its console and its requests."""
    from selenium import webdriver

    options = webdriver.ChromeOptions()
    for argument in ("--headless=new", "--no-sandbox", "--enable-unsafe-swiftshader",
                     f"--window-size={width},{height}"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    return webdriver.Chrome(options=options)


def attach_to_chromium(port):
    """A Chromium that already runs, by its debugging port."""
    from selenium import webdriver

    options = webdriver.ChromeOptions()
    options.debugger_address = f"127.0.0.1:{port}"
    return webdriver.Chrome(options=options)


class Marionette:
    """A Firefox that already runs, by its own protocol: Debian has no geckodriver, which Selenium needs."""

    def __init__(self, port):
        with socket.create_connection(("127.0.0.1", port), timeout=180) as connection:
            self.stream = connection.makefile("rwb")  # keeps it open
        self.sent = 0
        self.receive()  # it introduces itself
        self.ask("WebDriver:NewSession")

    def receive(self):
        size = b""
        while (byte := self.stream.read(1)) != b":":
            size += byte
        return json.loads(self.stream.read(int(size)))

    def ask(self, command, **parameters):
        self.sent += 1
        message = json.dumps([0, self.sent, command, parameters]).encode()
        self.stream.write(b"%d:%s" % (len(message), message))
        self.stream.flush()
        _, _, error, result = self.receive()
        if error:
            raise RuntimeError(error["message"])
        return result.get("value")

    def close(self):
        self.stream.close()
