#!/usr/bin/env python3
"""Checks which folder includes which, and that every source file is built.

    scripts/check_arrows.py [FOLDER]    FOLDER: the project's root, this script's parent by default

Prints one line for each violation and exits with 1 if there is any.
"""

import re
import sys
from pathlib import Path

# Rooms of the library, in order, with the rooms each may include.
ARROWS = {
    "base": "",
    "mesh": "base",
    "field": "base mesh",
    "terrain": "base mesh field",
    "tools": "base mesh field terrain",
    "settle": "base mesh field terrain",
    "rocks": "base mesh field",
    "piles": "base mesh field terrain rocks",
    "scatter": "base mesh field terrain",
    "roads": "base mesh field terrain",
    "io": "base mesh field terrain tools settle rocks piles scatter roads",
    "scene": "base mesh field terrain tools settle rocks piles scatter roads io",
    "render": "base mesh",
}

# Libraries that no header shows outside the rooms that own them.
FOREIGN = {
    "OpenGL": (r"(epoxy|GL|EGL|GLES\d?|KHR)/", "render"),
    "GLFW": (r"GLFW/", ""),
    "ImGui": (r"imgui", ""),
    "CLI11": (r"CLI/", ""),
    "JSON": (r"nlohmann/", "io scene"),
    "TOML": (r"toml(\+\+/|\.hpp)", "scene"),
    "GDAL": (r"(gdal|ogr_|cpl_)", "io"),
    "assimp": (r"assimp/", "io"),
    "tinygltf": (r"tiny_?gltf", "io"),
    "libpng": (r"png\.h", "io"),
}

INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]')


def includes(path):
    """Yields (line number, quoted, name) of each include directive."""
    for number, line in enumerate(path.read_text().splitlines(), 1):
        if match := INCLUDE.match(line):
            yield number, match[1] == '"', match[2]


def check_file(path, room, where):
    """Yields what is wrong with the includes of one file of a room."""
    allowed = ARROWS[room].split() + [room]
    for number, quoted, name in includes(path):
        parts = name.split("/")
        if quoted and parts[0] != "talus":
            yield f'{where}:{number}: "{name}": the library includes its own headers as "talus/..."'
        elif parts[0] == "talus" and len(parts) > 2 and parts[1] not in allowed:
            yield f"{where}:{number}: {room} may not include {parts[1]}; allowed: {' '.join(allowed)}"
        if path.suffix == ".h":
            for library, (pattern, owners) in FOREIGN.items():
                if re.match(pattern, name) and room not in owners.split():
                    yield f"{where}:{number}: {library} in a header of {room}; keep it in a .cpp"


def check_room(folder, root):
    """Yields what is wrong in one room."""
    room = folder.name
    if room not in ARROWS:
        yield f"{folder.relative_to(root)}: no such room; add it to the table in check_arrows.py"
        return
    lists = "\n".join(path.read_text() for path in folder.rglob("CMakeLists.txt"))
    listed = set(re.findall(r"[\w./-]+\.cpp\b", re.sub(r"#.*", "", lists)))
    for path in sorted(folder.rglob("*")):
        where = path.relative_to(root)
        if path.suffix in (".h", ".cpp"):
            yield from check_file(path, room, where)
        if path.suffix == ".cpp" and path.relative_to(folder).as_posix() not in listed:
            yield f"{where}: not built; add it to {folder.relative_to(root)}/CMakeLists.txt"


def main():
    root = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent.parent).resolve()
    rooms = sorted(path for path in (root / "talus").iterdir() if path.is_dir())
    violations = [line for room in rooms for line in check_room(room, root)]
    for line in violations:
        print(line)
    return 1 if violations else 0


if __name__ == "__main__":
    sys.exit(main())
