"""What several of the Python tests need: the program, and a browser."""

import importlib.util
import os
import shutil
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
