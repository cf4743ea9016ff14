"""Builds the extension module with CMake and puts it into the package, with scenes, robots and episodes.

VANTAGE_BUILD_DIR names a folder that was configured before (build/release); default: build/pip, made anew.
"""

import os
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

SOURCE = Path(__file__).resolve().parent
DATA = ["models/robots", "models/scenes", "assets/episodes", "assets/models", "assets/sensors", "assets/views"]


class CMakeBuild(build_ext):
    def build_extension(self, ext):
        build = Path(os.environ.get("VANTAGE_BUILD_DIR") or SOURCE / "build/pip").resolve()
        if "VANTAGE_BUILD_DIR" not in os.environ or not (build / "build.ninja").is_file():
            subprocess.run(["cmake", "-S", str(SOURCE), "-B", str(build), "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                            "-DVANTAGE_BUILD_TESTS=OFF", f"-DPython3_EXECUTABLE={sys.executable}"], check=True)
        subprocess.run(["cmake", "--build", str(build), "--target", "vantage_python"], check=True)
        module = Path(self.get_ext_fullpath(ext.name))
        module.parent.mkdir(parents=True, exist_ok=True)
        built = build / "python/vantage" / module.name
        if not built.is_file():
            raise SystemExit(f"{built}: was not built; are python3-dev and pybind11-dev there, and is {build} of this Python?")
        shutil.copy2(built, module)
        for folder in DATA:
            shutil.copytree(SOURCE / folder, module.parent / "share" / folder, dirs_exist_ok=True)


setup(ext_modules=[Extension("vantage._core", sources=[])], cmdclass={"build_ext": CMakeBuild})
