#!/usr/bin/env python3
"""Checks that no room includes what it may not: the picture in docs/architecture.md, as data.

All code shares one include root, so a wrong include would compile.

usage: include_directions.py ROOT
"""
import pathlib
import re
import sys

CORE_SIBLINGS = ["core/simplify", "core/compare", "core/format", "core/encode"]
BELOW_SIBLINGS = ["core/base", "core/mesh", "core/scene"]
CORE = BELOW_SIBLINGS + CORE_SIBLINGS + ["core/optimize", "core/sample"]

# What each room may include besides itself. A file belongs to the longest room that its path starts with.
ROOMS = {
    "core/base": [],
    "core/mesh": ["core/base"],
    "core/scene": ["core/base", "core/mesh"],
    **{room: BELOW_SIBLINGS for room in CORE_SIBLINGS},
    "core/optimize": BELOW_SIBLINGS + CORE_SIBLINGS,
    "core/sample": BELOW_SIBLINGS,
    "proto": CORE,
    "server/http": CORE + ["proto"],
    "server/store": CORE + ["proto"],
    "server/blobs": CORE + ["proto"],
    "server/telemetry": CORE + ["proto"],
    "server/jobs": CORE + ["proto", "server/store", "server/blobs", "server/telemetry"],
    "server/routes": CORE + [
        "proto", "server/http", "server/jobs", "server/store", "server/blobs", "server/telemetry"],
    # config and app, which put the others together
    "server": CORE + [
        "proto", "server/http", "server/store", "server/blobs", "server/telemetry", "server/jobs", "server/routes"],
    "cli": CORE + ["proto", "server"],
}

# Who may include a library. One that is not listed is free.
LIBRARIES = {
    r"httplib\.h": ["server/http"],
    r"nlohmann/": ["proto", "core/format/gltf"],
    r"(tiny_gltf|tinygltf/.*)\.h": ["core/format/gltf"],
    r"draco/": ["core/format/gltf", "core/encode"],
    r"meshoptimizer\.h": ["core/format/gltf", "core/encode"],
    r"zip\.h": ["core/format"],
    r"png\.h": ["core/sample"],
    r"OpenMesh/": ["core/simplify"],
    r"(tbb|oneapi)/": ["core/base"],
    r"spdlog/": ["server", "cli"],
    r"CLI/": ["cli"],
    r"prometheus/": ["server"],
    r"toml\+\+/": ["server"],
    r"(sys/socket|netinet/.*|arpa/.*|netdb)\.h": ["server/http"],
    r"iostream$": ["cli", "server"],
}

# Core reads no environment and prints nothing.
FORBIDDEN_IN_CORE = re.compile(r"\b(getenv|std::cout|std::cerr|std::clog|std::printf|fprintf|puts)\b")

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
CODE_FOLDERS = ["core", "proto", "server", "cli"]
TEST_FOLDERS = ["tests", "bench", "fuzz"]
SUFFIXES = {".h", ".cpp"}


def room_of(path):
    fitting = [room for room in ROOMS if path.startswith(room + "/")]
    return max(fitting, key=len, default=None)


def may_include(room, target):
    """Whether `room` may include a file of the room `target`; permission for a room covers what lies in it."""
    return any(target == allowed or target.startswith(allowed + "/") for allowed in [room] + ROOMS[room]) and not (
        # "server" is also the parent of its own rooms, and they may not reach up into it
        target == "server" and room.startswith("server/")
    )


def faults_in(path, text):
    """Yields (line number, message) for one file; path is relative to the root and uses '/'."""
    is_test = path.split("/")[0] in TEST_FOLDERS
    room = None if is_test else room_of(path)
    if room is None and not is_test:
        yield 1, f"{path} lies in no room; the rooms are {', '.join(ROOMS)}"
        return
    for number, line in enumerate(text.splitlines(), 1):
        match = INCLUDE.match(line)
        if match:
            yield from ((number, message) for message in include_faults(path, room, *match.groups()))
        elif room and room.startswith("core/") and FORBIDDEN_IN_CORE.search(line.split("//")[0]):
            yield number, "core reads no environment and prints nothing"


def include_faults(path, room, quote, name):
    if quote == "<":
        if room:
            for library, allowed in LIBRARIES.items():
                if re.match(library, name) and not any(path.startswith(place + "/") for place in allowed):
                    yield f"<{name}> may be included in {', '.join(allowed)} only"
        return
    if name.split("/")[0] not in CODE_FOLDERS + TEST_FOLDERS or ".." in name:
        yield f'"{name}" is not written from the root'
        return
    if room is None:
        return
    target = room_of(name)
    if target is None:
        yield f'"{name}" lies in no room that {room} may include'
    elif not may_include(room, target):
        yield f'{room} may not include {target}: "{name}"'


def main(root):
    root = pathlib.Path(root)
    files = [
        file
        for folder in CODE_FOLDERS + TEST_FOLDERS
        for file in sorted((root / folder).rglob("*"))
        if file.suffix in SUFFIXES and "node_modules" not in file.parts
    ]
    if not files:
        print(f"no source files under {root}")
        return 1
    faults = 0
    for file in files:
        path = file.relative_to(root).as_posix()
        for number, message in faults_in(path, file.read_text(encoding="utf-8")):
            print(f"{path}:{number}: {message}")
            faults += 1
    print(f"{len(files)} files, {faults} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
