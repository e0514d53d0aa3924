#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Enfilade authors
# SPDX-License-Identifier: Apache-2.0
"""Tests of scripts/check_layers.py on copies of this tree with one thing made wrong."""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]


class CheckLayersTest(unittest.TestCase):

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="enfilade-layers-")
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        for name in ("cmake", "include", "src"):
            shutil.copytree(ROOT / name, self.root / name)

    def check(self):
        """Exit status and output of the check on the copy."""
        run = subprocess.run([sys.executable, ROOT / "scripts/check_layers.py", self.root],
                             capture_output=True, text=True, check=False)
        self.assertEqual(run.stderr, "")
        return run.returncode, run.stdout

    def add_line(self, name, line):
        path = self.root / name
        path.write_text(path.read_text() + line + "\n")

    def use(self, module, other):
        """Adds `other` to what `module` may use."""
        path = self.root / f"src/{module}/CMakeLists.txt"
        text = path.read_text()
        if "USES" in text:
            path.write_text(text.replace("USES", f"USES {other}", 1))
        else:
            path.write_text(re.sub(r"\n  SOURCES", f"\n  USES {other}\n  SOURCES", text, count=1))

    def expect_problem(self, *parts):
        status, output = self.check()
        self.assertEqual(status, 1, output)
        self.assertTrue(any(all(part in line for part in parts) for line in output.splitlines()),
                        f"{parts} not in one line of:\n{output}")

    def test_the_tree_itself_passes(self):
        status, output = self.check()
        self.assertEqual(status, 0, output)
        self.assertIn("no forbidden include", output)

    def test_one_name_in_two_modules(self):
        self.add_line("src/sfm/level_rays.h",
                      "[[nodiscard]] double Twice(\n    const std::vector<double>& values, int n = 3);")
        self.add_line("src/structure/height_scores.h",
                      "inline bool Twice(const std::vector<double>& v, int number) { return true; }")
        self.expect_problem("two modules declare Twice(std::vector<double>&, int)",
                            "src/structure/height_scores.h")

    def test_one_type_in_two_modules(self):
        self.add_line("src/sfm/level_rays.h", "struct Twice {\n  int x;\n};")
        self.add_line("include/enfilade/structure/heights.h", "class Twice final {\n};")
        self.expect_problem("src/sfm/level_rays.h", "two modules declare Twice")

    def test_overloads_are_no_problem(self):
        self.add_line("src/sfm/level_rays.h", "double Twice(double x);")
        self.add_line("src/structure/height_scores.h", "double Twice(double x, double y);")
        self.assertEqual(self.check()[0], 0)

    def test_include_of_a_later_module(self):
        self.add_line("src/geometry/polygon2.cc", '#include "enfilade/scene/camera.h"')
        num_lines = len((self.root / "src/geometry/polygon2.cc").read_text().splitlines())
        self.expect_problem(f"src/geometry/polygon2.cc:{num_lines}: geometry may not include scene")

    def test_include_in_a_public_header(self):
        self.add_line("include/enfilade/image/image.h", '#  include <enfilade/floorplan/types.h>')
        self.expect_problem("include/enfilade/image/image.h:", "image may not include floorplan")

    def test_include_of_an_earlier_module_that_is_not_listed(self):
        self.add_line("src/optim/grid_cut.cc", '#include "enfilade/geometry/angles.h"')
        self.expect_problem("src/optim/grid_cut.cc:", "optim may not include geometry")

    def test_use_of_a_later_module(self):
        self.use("geometry", "scene")
        self.expect_problem("src/geometry/CMakeLists.txt: geometry may not use scene")

    def test_cycle(self):
        # scene uses geometry already: with geometry using scene the two go round.
        self.use("geometry", "scene")
        self.add_line("src/geometry/polygon2.cc", '#include "enfilade/scene/camera.h"')
        self.expect_problem("geometry may not use scene, which does not stand before it")

    def test_use_of_itself(self):
        self.use("scene", "scene")
        self.expect_problem("scene may not use scene")

    def test_order_of_the_list_decides(self):
        path = self.root / "cmake/EnfiladeModule.cmake"
        text = path.read_text()
        self.assertIn("base geometry optim image", text)
        path.write_text(text.replace("base geometry optim image", "geometry base optim image"))
        self.expect_problem("geometry may not use base, which does not stand before it")

    def test_unknown_module_in_uses(self):
        self.use("scene", "vision")
        self.expect_problem("scene may not use vision")

    def test_module_that_is_not_in_the_list(self):
        path = self.root / "cmake/EnfiladeModule.cmake"
        path.write_text(path.read_text().replace("optim image", "image", 1))
        self.expect_problem("optim is not in ENFILADE_MODULES")

    def test_synthetic_is_for_tests_and_the_program(self):
        self.use("pipeline", "synthetic")
        self.expect_problem("pipeline may not use synthetic", "for tests and the program")
        self.add_line("src/structure/types.cc", '#include "enfilade/synthetic/home.h"')
        self.expect_problem("structure may not include synthetic")

    def test_apps_tests_and_private_headers(self):
        self.add_line("src/scene/camera.cc", '#include "apps/enfilade/commands.h"')
        self.expect_problem("src/scene/camera.cc:", "scene may not include apps")
        self.add_line("src/scene/types.cc", '#include "tests/support/temp_folder.h"')
        self.expect_problem("src/scene/types.cc:", "scene may not include tests")
        self.add_line("src/image/codec.cc", '#include "src/base/secret.h"')
        self.expect_problem("src/image/codec.cc:", "private headers: src/base/secret.h")
        self.add_line("include/enfilade/base/file.h", '#include "src/base/secret.h"')
        self.expect_problem("include/enfilade/base/file.h:", "private headers")

    def test_paths_with_dots_cannot_hide_an_include(self):
        self.add_line("src/geometry/polygon2.cc", '#include "../../include/enfilade/scene/types.h"')
        self.expect_problem("src/geometry/polygon2.cc:", "path with ..")

    def test_third_party_in_a_public_header(self):
        self.add_line("include/enfilade/image/codec.h", "#include <opencv2/core.hpp>")
        self.expect_problem("include/enfilade/image/codec.h:", "may not include opencv2/core.hpp")
        self.add_line("include/enfilade/base/json.h", "#include <nlohmann/json.hpp>")
        self.expect_problem("include/enfilade/base/json.h:", "may not include nlohmann/json.hpp")

    def test_source_that_is_not_listed(self):
        (self.root / "src/scene/forgotten.cc").write_text("")
        self.expect_problem("src/scene/forgotten.cc: missing from SOURCES")
        (self.root / "include/enfilade/scene/forgotten.h").write_text("")
        self.expect_problem("include/enfilade/scene/forgotten.h: missing from HEADERS")

    def test_comments_in_cmake_files_are_no_modules(self):
        path = self.root / "src/scene/CMakeLists.txt"
        path.write_text(path.read_text().replace("USES", "USES  # and no evidence (yet)\n ", 1))
        status, output = self.check()
        self.assertEqual(status, 0, output)


if __name__ == "__main__":
    unittest.main()
