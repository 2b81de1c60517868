"""Builds the Python package for pip (PEP 517): CMake builds and installs it, and a wheel is made of the files.

The build tree is kept in build/, so that a second build is short. CMAKE_BUILD_PARALLEL_LEVEL sets how many compilers
run at once; by default one for each processor, as far as the memory allows.
"""

import base64
import hashlib
import os
import re
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import zipfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
NAME = "penumbra"
MEMORY_OF_A_COMPILER = 1.5e9  # bytes
FIRST_DATE = (1980, 1, 1, 0, 0, 0)  # of the files in a wheel: the same files give the same bytes


def _version():
    with open(os.path.join(ROOT, "CMakeLists.txt"), encoding="utf-8") as file:
        return re.search(r"project\(penumbra VERSION ([0-9.]+)", file.read()).group(1)


def _metadata():
    return (f"Metadata-Version: 2.1\nName: {NAME}\nVersion: {_version()}\n"
            "Summary: The light in scenes of diffuse polygons\nRequires-Python: >=3.9\nRequires-Dist: numpy\n")


def _tag():
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{re.sub('[-.]', '_', sysconfig.get_platform())}"


def _jobs():
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    most = min(os.cpu_count() or 1, int(memory / MEMORY_OF_A_COMPILER))
    return os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(max(1, most)))


def _install_to(folder):
    """Builds the package and installs its files into the folder."""
    tree = os.path.join(ROOT, "build", f"python-{sys.implementation.cache_tag}")
    subprocess.run(["cmake", "-S", ROOT, "-B", tree, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                    "-DCMAKE_UNITY_BUILD=ON", "-DCMAKE_UNITY_BUILD_BATCH_SIZE=10", "-DPENUMBRA_TESTS=OFF",
                    "-DPENUMBRA_EXAMPLES=OFF", "-DPENUMBRA_EXPERIMENTS=OFF", "-DPENUMBRA_PYTHON=ON",
                    "-DPENUMBRA_PYTHON_DIR=.", f"-DPython3_EXECUTABLE={sys.executable}"], check=True)
    with open(os.path.join(tree, "build.ninja"), encoding="utf-8") as file:
        if "penumbra_package" not in file.read():
            raise SystemExit("the Python package is left out: install pybind11-dev and python3-dev, or the headers of "
                             f"{sys.executable}")
    subprocess.run(["cmake", "--build", tree, "--target", "penumbra_package", "--parallel", _jobs()], check=True)
    subprocess.run(["cmake", "--install", tree, "--component", "python", "--strip", "--prefix", folder], check=True)


def _write_wheel(path, files):
    """`files` are the paths in the wheel with their bytes."""
    information = f"{NAME}-{_version()}.dist-info"
    files = dict(files)
    files[f"{information}/METADATA"] = _metadata().encode()
    files[f"{information}/WHEEL"] = (f"Wheel-Version: 1.0\nGenerator: {NAME}\nRoot-Is-Purelib: false\n"
                                     f"Tag: {_tag()}\n").encode()
    record = ""
    for name, content in sorted(files.items()):
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        record += f"{name},sha256={digest},{len(content)}\n"
    files[f"{information}/RECORD"] = (record + f"{information}/RECORD,,\n").encode()
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as wheel:
        for name, content in sorted(files.items()):
            entry = zipfile.ZipInfo(name, FIRST_DATE)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = (0o755 if name.endswith(".so") else 0o644) << 16
            wheel.writestr(entry, content)


def get_requires_for_build_wheel(config_settings=None):
    return []


def get_requires_for_build_sdist(config_settings=None):
    return []


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    name = f"{NAME}-{_version()}-{_tag()}.whl"
    with tempfile.TemporaryDirectory() as folder:
        _install_to(folder)
        files = {}
        for where, _, names in os.walk(folder):
            for one in names:
                path = os.path.join(where, one)
                with open(path, "rb") as file:
                    files[os.path.relpath(path, folder)] = file.read()
        if not any(path.endswith(".so") for path in files):
            raise SystemExit("CMake installed no module of the Python package")
        _write_wheel(os.path.join(wheel_directory, name), files)
    return name


def build_sdist(sdist_directory, config_settings=None):
    """The checkout without what is built in it."""
    name = f"{NAME}-{_version()}"

    def keep(entry):
        parts = entry.name.split("/")[1:]
        return None if parts and (parts[0] in (".git", "build") or "__pycache__" in parts) else entry

    with tarfile.open(os.path.join(sdist_directory, f"{name}.tar.gz"), "w:gz", format=tarfile.PAX_FORMAT) as archive:
        archive.add(ROOT, name, filter=keep)
        with tempfile.NamedTemporaryFile("w", encoding="utf-8") as information:
            information.write(_metadata())
            information.flush()
            archive.add(information.name, f"{name}/PKG-INFO")
    return f"{name}.tar.gz"
