"""Builds the wheel and the source distribution of Abut: a PEP 517 backend that calls CMake.

Settings (pip wheel . --config-settings NAME=VALUE):
    cmake-args   more arguments for CMake, separated by spaces
    build-dir    a build folder to use and keep; one that is configured already stays as it is configured
"""

import base64
import hashlib
import io
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SUMMARY = "Proximity queries on triangle models"


def version():
    return re.search(r"project\(Abut VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text())[1]


def tag():
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    return f"{python}-{python}-{platform}"


def metadata():
    head = (f"Metadata-Version: 2.1\nName: abut\nVersion: {version()}\nSummary: {SUMMARY}\n"
            "License: MIT\nRequires-Python: >=3.9\nRequires-Dist: numpy\nDescription-Content-Type: text/markdown\n\n")
    return head + (ROOT / "docs/python.md").read_text()


def get_requires_for_build_wheel(config_settings=None):
    return []


def get_requires_for_build_sdist(config_settings=None):
    return []


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    settings = config_settings or {}
    with tempfile.TemporaryDirectory() as scratch:
        build = pathlib.Path(settings.get("build-dir") or pathlib.Path(scratch, "build"))
        package = pathlib.Path(scratch, "package")
        if not (build / "CMakeCache.txt").exists():
            configure(build, shlex.split(settings.get("cmake-args", "")))
        run("cmake", "--build", build, "--parallel", os.cpu_count(), "--target", "abut_wheel")
        run("cmake", "--install", build, "--component", "wheel", "--prefix", package)
        modules = [path.name for path in (package / "abut").glob("_abut*")]
        if modules != ["_abut" + sysconfig.get_config_var("EXT_SUFFIX")]:
            raise SystemExit(f"{build} is for another Python: it made {modules}")
        name = f"abut-{version()}-{tag()}.whl"
        write_wheel(pathlib.Path(wheel_directory, name), package)
    return name


def configure(build, more):
    generator = ["-G", "Ninja"] if shutil.which("ninja") else []
    run("cmake", "-S", ROOT, "-B", build, "-DCMAKE_BUILD_TYPE=Release", "-DABUT_PYTHON=ON", "-DABUT_TESTS=OFF",
        "-DABUT_BENCH=OFF", "-DABUT_EXAMPLES=OFF", "-DABUT_UNITY=ON", f"-DPython_EXECUTABLE={sys.executable}", *generator,
        *more)


def run(*command):
    subprocess.run([str(word) for word in command], check=True)


def write_wheel(path, package):
    info = f"abut-{version()}.dist-info"
    record = []
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as wheel:
        def add(name, data, mode=0o644):
            entry = zipfile.ZipInfo(name)  # of a fixed date: the same files give the same wheel
            entry.external_attr = (0o100000 | mode) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            wheel.writestr(entry, data)
            digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
            record.append(f"{name},sha256={digest},{len(data)}")

        for file in sorted(p for p in package.rglob("*") if p.is_file()):
            mode = 0o755 if os.access(file, os.X_OK) else 0o644
            add(file.relative_to(package).as_posix(), file.read_bytes(), mode)
        add(f"{info}/METADATA", metadata().encode())
        add(f"{info}/WHEEL",
            f"Wheel-Version: 1.0\nGenerator: abut\nRoot-Is-Purelib: false\nTag: {tag()}\n".encode())
        add(f"{info}/LICENSE", (ROOT / "LICENSE").read_bytes())
        add(f"{info}/RECORD", "\n".join([*record, f"{info}/RECORD,,", ""]).encode())


def build_sdist(sdist_directory, config_settings=None):
    name = f"abut-{version()}"
    path = pathlib.Path(sdist_directory, f"{name}.tar.gz")
    with tarfile.open(path, "w:gz", format=tarfile.PAX_FORMAT) as archive:
        for file in sources():
            archive.add(ROOT / file, f"{name}/{file}", recursive=False)
        info, text = tarfile.TarInfo(f"{name}/PKG-INFO"), metadata().encode()
        info.size = len(text)
        archive.addfile(info, io.BytesIO(text))
    return path.name


def sources():
    """The files that a build needs: of git where there is one, else all that lie there."""
    folders = ("apps", "cmake", "include", "python", "scenes", "src")
    files = ("CMakeLists.txt", "LICENSE", "README.md", "docs/python.md", "pyproject.toml")
    listed = []
    if (ROOT / ".git").exists():
        listed = subprocess.run(["git", "-C", str(ROOT), "ls-files", *folders, *files], check=True,
                                capture_output=True, text=True).stdout.splitlines()
    if not listed:
        listed = [str(p.relative_to(ROOT)) for folder in folders for p in (ROOT / folder).rglob("*")
                  if p.is_file() and not {"node_modules", "__pycache__"} & set(p.parts)] + list(files)
    return sorted(listed)
