"""What pip calls to build the package; building itself takes minutes and is not tried here."""

import base64
import csv
import hashlib
import os
import sys
import tarfile
import zipfile

import penumbra
from conftest import ROOT

sys.path.insert(0, os.path.join(ROOT, "python", "backend"))
import penumbra_build  # noqa: E402


def test_a_wheel_tells_the_digests_of_its_files(tmp_path):
    path = tmp_path / "a.whl"
    penumbra_build._write_wheel(path, {"penumbra/core.so": b"\x7fELF", "penumbra/__init__.py": b""})
    with zipfile.ZipFile(path) as wheel:
        folder = f"penumbra-{penumbra.__version__}.dist-info"
        rows = {row[0]: row[1:] for row in csv.reader(wheel.read(f"{folder}/RECORD").decode().splitlines())}
        assert set(rows) == set(wheel.namelist())
        for name, (digest, size) in rows.items():
            content = wheel.read(name)
            if name.endswith("RECORD"):
                continue
            expected = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
            assert (digest, int(size)) == (f"sha256={expected}", len(content))
        assert b"Requires-Dist: numpy" in wheel.read(f"{folder}/METADATA")
        assert penumbra_build._tag().encode() in wheel.read(f"{folder}/WHEEL")
    first = path.read_bytes()
    penumbra_build._write_wheel(path, {"penumbra/__init__.py": b"", "penumbra/core.so": b"\x7fELF"})
    assert path.read_bytes() == first


def test_an_archive_of_sources_holds_the_checkout(tmp_path):
    name = penumbra_build.build_sdist(tmp_path)
    with tarfile.open(tmp_path / name) as archive:
        names = {entry.split("/", 1)[1] for entry in archive.getnames() if "/" in entry}
    assert {"CMakeLists.txt", "pyproject.toml", "python/module.cpp", "PKG-INFO"} <= names
    assert not any(entry.startswith(("build", ".git/")) for entry in names)
    assert penumbra_build.get_requires_for_build_wheel() == []
