"""The arrow checker finds what it must and nothing else, in small made-up trees."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

CHECKER = Path(__file__).parents[2] / "scripts" / "check_arrows.py"


def check(files):
    """Exit status and output of the checker on a tree of {path: text}."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in files.items():
            path = Path(folder) / "talus" / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        done = subprocess.run([sys.executable, CHECKER, folder], capture_output=True, text=True)
        return done.returncode, done.stdout


class CheckArrows(unittest.TestCase):
    def assert_refused(self, files, *fragments):
        status, output = check(files)
        self.assertEqual(status, 1, output)
        self.assertEqual(len(output.splitlines()), 1, output)
        for fragment in fragments:
            self.assertIn(fragment, output)

    def test_accepts_arrows_that_point_down(self):
        status, output = check({
            "base/vec.h": "#include <glm/vec3.hpp>\n",
            "io/png.h": '#include "talus/base/vec.h"\n',
            "io/png.cpp": '#include <png.h>\n#include "talus/io/png.h"\n',
            "io/CMakeLists.txt": "target_sources(talus PRIVATE png.cpp)\n",
        })
        self.assertEqual((status, output), (0, ""))

    def test_refuses_an_arrow_that_points_up(self):
        self.assert_refused({"base/vec.h": '// Two lines.\n#include "talus/mesh/check.h"\n'},
                            "talus/base/vec.h:2", "base may not include mesh")

    def test_refuses_siblings(self):
        self.assert_refused({"roads/road.h": '#include  "talus/scatter/strew.h"\n'},
                            "roads may not include scatter")

    def test_refuses_angle_brackets_that_point_up(self):
        self.assert_refused({"mesh/check.h": "#  include <talus/io/png.h>\n"},
                            "mesh may not include io")

    def test_refuses_relative_includes(self):
        self.assert_refused({"base/vec.h": '#include "hash.h"\n'}, '"hash.h"')

    def test_refuses_foreign_headers_outside_their_room(self):
        for room, name, library in [("scene", "epoxy/gl.h", "OpenGL"),
                                    ("io", "toml++/toml.h", "TOML"),
                                    ("mesh", "nlohmann/json.hpp", "JSON"),
                                    ("scene", "assimp/scene.h", "assimp"),
                                    ("render", "tiny_gltf.h", "tinygltf"),
                                    ("field", "gdal_priv.h", "GDAL")]:
            with self.subTest(library):
                self.assert_refused({f"{room}/some.h": f"#include <{name}>\n"}, library)

    def test_allows_foreign_headers_in_sources(self):
        status, output = check({"render/context.cpp": "#include <epoxy/egl.h>\n",
                                "render/CMakeLists.txt": "target_sources(talus PRIVATE context.cpp)"})
        self.assertEqual((status, output), (0, ""))

    def test_refuses_a_source_that_is_not_built(self):
        self.assert_refused({"base/hash.cpp": "",
                             "base/CMakeLists.txt": "# hash.cpp\ntarget_sources(talus PRIVATE)\n"},
                            "talus/base/hash.cpp: not built")

    def test_refuses_an_unknown_room(self):
        self.assert_refused({"attic/box.h": ""}, "talus/attic")


if __name__ == "__main__":
    unittest.main()
