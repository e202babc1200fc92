"""Builds the Python package with CMake: the extension, and the library beside it."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

top = Path(__file__).resolve().parent


class CMakeBuild(build_ext):
    """Installs the component `python` of a CMake build into the package.

    WHEELWRIGHT_BUILD names a finished build to use, configured with WHEELWRIGHT_PYTHON for the same Python;
    otherwise one is made in build/pip.
    """

    def run(self) -> None:
        given = os.environ.get("WHEELWRIGHT_BUILD")
        build = Path(given) if given else top / "build" / "pip"
        if not given:
            options = {
                "CMAKE_BUILD_TYPE": "Release",
                "WHEELWRIGHT_PYTHON": "ON",
                "WHEELWRIGHT_BENCHMARKS": "OFF",
                "BUILD_TESTING": "OFF",
                "Python_EXECUTABLE": sys.executable,
            }
            settings = [f"-D{name}={value}" for name, value in options.items()]
            self.call("cmake", "-G", "Ninja", "-S", top, "-B", build, *settings)
            self.call("cmake", "--build", build, "--target", "python_package")
        prefix = Path(self.build_temp) / "prefix"
        self.call("cmake", "--install", build, "--prefix", prefix, "--component", "python")
        package = Path(self.build_lib) / "wheelwright"
        package.mkdir(parents=True, exist_ok=True)
        for extension in prefix.rglob("*.so"):
            shutil.copy2(extension, package)
        for library in (build / "bin").glob("libwheelwright.so.*"):
            if library.is_symlink() or library.name.count(".") == 3:
                shutil.copy2(library, package, follow_symlinks=True)

    def call(self, *command: object) -> None:
        subprocess.run([str(part) for part in command], check=True)


setup(ext_modules=[Extension("wheelwright._core", [])], cmdclass={"build_ext": CMakeBuild})
