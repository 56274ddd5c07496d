"""pip install .: CMake builds the module, setuptools packs it.

EMMY_CMAKE_BUILD names a folder that CMake has configured already, to use what
is compiled there; CMAKE_ARGS are further arguments for the configuration.
"""

import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent


def version():
    text = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    return re.search(r"^  VERSION (\d+\.\d+\.\d+)$", text, re.MULTILINE)[1]


class BuildByCMake(build_ext):
    def build_extension(self, ext):
        known = os.environ.get("EMMY_CMAKE_BUILD")
        build = pathlib.Path(known or self.build_temp).resolve()
        if not known:
            build.mkdir(parents=True, exist_ok=True)
            subprocess.run(
                ["cmake", "-S", ROOT, "-B", build, "-G", "Ninja",
                 "-DCMAKE_BUILD_TYPE=Release", "-DEMMY_BUILD_PYTHON=ON",
                 "-DEMMY_BUILD_TESTS=OFF", "-DEMMY_BUILD_BENCHMARKS=OFF",
                 "-DEMMY_BUILD_VERIFICATION=OFF",
                 "-DEMMY_WARNINGS_AS_ERRORS=OFF",
                 f"-DPython_EXECUTABLE={sys.executable}",
                 *shlex.split(os.environ.get("CMAKE_ARGS", ""))],
                check=True)
        subprocess.run(["cmake", "--build", build, "--target", "emmy_python"],
                       check=True)
        made = list((build / "python" / "emmy").glob("_emmy*.so"))
        if len(made) != 1:
            raise RuntimeError(f"expected one module in {build}, got {made}")
        target = pathlib.Path(self.get_ext_fullpath(ext.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(made[0], target)


setup(
    version=version(),
    ext_modules=[Extension("emmy._emmy", sources=[])],
    cmdclass={"build_ext": BuildByCMake},
)
