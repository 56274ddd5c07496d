"""pip install: builds, installs, and imports from where it was put."""
import importlib.metadata
import importlib.util
import os
import pathlib
import shutil
import subprocess
import sys
import zipfile

import pytest

from conftest import ROOT

for package in ("pip", "setuptools", "wheel", "venv"):
    if importlib.util.find_spec(package) is None:
        pytest.skip(f"{package} is not installed", allow_module_level=True)

PIP_OPTIONS = ["--no-deps", "--no-index", "--disable-pip-version-check",
               "--root-user-action=ignore"]
CHECK = """
import emmy, sys
assert emmy.__file__.startswith(sys.argv[1]), emmy.__file__
simulation = emmy.Simulation.from_file(sys.argv[2])
simulation.run(10)
assert simulation.energy.max_relative_error < 1e-14
import importlib.metadata
assert importlib.metadata.version("emmy") == emmy.__version__
"""


@pytest.fixture
def sources(tmp_path):
    """What `setup.py sdist` packs; made of a copy, for it leaves its traces."""
    copy = tmp_path / "copy"
    copy.mkdir()
    for name in ("CMakeLists.txt", "LICENSE", "MANIFEST.in", "README.md",
                 "pyproject.toml", "setup.py"):
        shutil.copy2(ROOT / name, copy)
    for name in ("cmake", "lib", "python", "tools"):
        shutil.copytree(ROOT / name, copy / name)
    (copy / "python" / "emmy" / "_emmy.cpython.so").touch()  # Of pip install -e.
    subprocess.run([sys.executable, "setup.py", "--quiet", "sdist"],
                   check=True, cwd=copy, env=environment())
    (archive,) = (copy / "dist").iterdir()
    shutil.unpack_archive(archive, tmp_path)
    (unpacked,) = (path for path in tmp_path.glob("emmy-*") if path.is_dir())
    return unpacked


def environment(**more):
    kept = {k: v for k, v in os.environ.items() if k != "PYTHONPATH"}
    return {**kept, **more}


@pytest.fixture
def wheels(tmp_path):
    """What pip fetches to build with, from what is installed here."""
    folder = tmp_path / "wheels"
    folder.mkdir()
    for name in ("setuptools", "wheel"):
        found = importlib.metadata.distribution(name)
        root = pathlib.Path(found.locate_file(""))
        info = f"{name}-{found.version}.dist-info"
        with zipfile.ZipFile(
            folder / f"{name}-{found.version}-py3-none-any.whl", "w"
        ) as wheel:
            for top in found.read_text("top_level.txt").split():
                for path in (root / top).rglob("*.*"):
                    if path.is_file() and path.suffix != ".pyc":
                        wheel.write(path, path.relative_to(root))
            for file, text in {
                "METADATA": found.read_text("METADATA")
                or found.read_text("PKG-INFO"),
                "entry_points.txt": found.read_text("entry_points.txt"),
                "WHEEL": "Wheel-Version: 1.0\nRoot-Is-Purelib: true\n"
                "Tag: py3-none-any\n",
                "RECORD": "".join(f"{file},,\n" for file in wheel.namelist()),
            }.items():
                wheel.writestr(f"{info}/{file}", text)
    return folder


def check(python, place, examples, **more):
    subprocess.run(
        [python, "-c", CHECK, str(place), str(examples / "paper_box.json")],
        check=True, cwd=place, env=environment(**more))


def test_pip_packs_what_is_built(sources, examples, tmp_path):
    target = tmp_path / "target"
    subprocess.run(
        [sys.executable, "-m", "pip", "install", "--no-build-isolation",
         *PIP_OPTIONS, "--target", target, "."],
        check=True, cwd=sources,
        env=environment(EMMY_CMAKE_BUILD=os.environ["EMMY_BINARY_DIR"]))
    check(sys.executable, target, examples, PYTHONPATH=str(target))
    assert (target / "emmy" / "py.typed").exists()
    assert (target / "emmy" / "_emmy.pyi").exists()


def test_the_archive_of_sources_has_all_of_them_and_no_binary(sources):
    packed = {
        path.relative_to(sources).as_posix()
        for path in sources.rglob("*") if path.is_file()
    }
    for folder in ("cmake", "lib", "python"):
        for path in (ROOT / folder).rglob("*"):
            if path.is_file() and path.suffix not in (".pyc", ".so"):
                name = path.relative_to(ROOT).as_posix()
                assert ".egg-info/" in name or name in packed
    assert not [name for name in packed if name.endswith(".so")]


@pytest.mark.skipif(
    not (ROOT / ".git").exists() or shutil.which("git") is None,
    reason="not a checkout")
def test_git_ignores_what_an_editable_installation_leaves():
    for name in ("python/emmy/_emmy.cpython-311-x86_64-linux-gnu.so",
                 "python/emmy.egg-info/PKG-INFO", "build/temp/build.ninja"):
        subprocess.run(["git", "-c", f"safe.directory={ROOT}", "check-ignore",
                        "--quiet", name], check=True, cwd=ROOT)


def test_the_build_needs_no_numpy(sources, tmp_path):
    """pip builds where setuptools is and nothing else."""
    place = tmp_path / "environment"
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", place],
                   check=True, env=environment())
    python = place / "bin" / "python"
    assert subprocess.run([python, "-c", "import numpy"], check=False,
                          capture_output=True, env=environment()).returncode
    result = subprocess.run(
        ["cmake", "-S", sources, "-B", tmp_path / "build", "-G", "Ninja",
         "-DEMMY_BUILD_PYTHON=ON", "-DEMMY_BUILD_TESTS=OFF",
         "-DEMMY_BUILD_BENCHMARKS=OFF", "-DEMMY_BUILD_VERIFICATION=OFF",
         f"-DPython_EXECUTABLE={python}"],
        capture_output=True, text=True, check=False, env=environment())
    assert result.returncode == 0, result.stderr


def test_pip_builds_from_scratch(sources, wheels, examples, tmp_path):
    """Into a virtual environment, and out of it again; takes minutes."""
    place = tmp_path / "environment"
    subprocess.run(
        [sys.executable, "-m", "venv", "--system-site-packages", place],
        check=True, env=environment())
    python = place / "bin" / "python"
    subprocess.run([python, "-m", "pip", "install", *PIP_OPTIONS,
                    "--find-links", wheels, "."],
                   check=True, cwd=sources, env=environment())
    check(python, place, examples)
    subprocess.run([python, "-m", "pip", "uninstall", "-y", "emmy"],
                   check=True, env=environment())
    assert not list(place.glob("lib/python3*/site-packages/emmy/*"))
