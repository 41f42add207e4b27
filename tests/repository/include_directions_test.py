#!/usr/bin/env python3
"""Shows that include_directions.py finds what it should: a check that cannot fail checks nothing."""
import contextlib
import io
import pathlib
import tempfile
import unittest

import include_directions

FORBIDDEN = [
    ("core/base/a.h", '#include "core/mesh/mesh.h"'),
    ("core/mesh/a.h", '#include "core/scene/scene.h"'),
    ("core/simplify/its.cpp", '#include "core/format/detect.h"'),
    ("core/encode/draco.cpp", '#include "core/simplify/registry.h"'),
    ("core/scene/a.cpp", '#include "core/optimize/report.h"'),
    ("core/optimize/a.cpp", '#include "proto/report.h"'),
    ("core/format/gltf/read.cpp", '#include "server/app.h"'),
    ("proto/report.cpp", '#include "server/http/request.h"'),
    ("server/http/a.cpp", '#include "server/routes/optimize.h"'),
    ("server/store/a.cpp", '#include "server/jobs/runner.h"'),
    ("server/jobs/a.cpp", '#include "server/http/request.h"'),
    ("server/jobs/a.cpp", '#include "server/app.h"'),
    ("server/app.cpp", '#include "cli/main.h"'),
    ("core/mesh/a.cpp", '#include "mesh.h"'),
    ("core/mesh/a.cpp", '#include "../base/error.h"'),
    ("core/util/a.h", ""),
    ("server/routes/a.cpp", "#include <httplib.h>"),
    ("server/routes/a.cpp", "#include <nlohmann/json.hpp>"),
    ("core/format/obj/a.cpp", "#include <nlohmann/json.hpp>"),
    ("core/format/obj/a.cpp", "#include <tiny_gltf.h>"),
    ("core/optimize/a.cpp", "#include <spdlog/spdlog.h>"),
    ("core/simplify/a.cpp", "#include <tbb/parallel_for.h>"),
    ("core/mesh/a.cpp", 'auto home = std::getenv("HOME");'),
    ("tests/core/a.cpp", '#include "mesh.h"'),
]

ALLOWED = [
    ("core/mesh/a.cpp", '#include "core/mesh/mesh.h"'),
    ("core/simplify/a.cpp", '#include "core/scene/scene.h"'),
    ("core/optimize/a.cpp", '#include "core/encode/draco.h"'),
    ("proto/a.cpp", '#include "core/optimize/report.h"'),
    ("proto/a.cpp", "#include <nlohmann/json.hpp>"),
    ("server/http/a.cpp", "#include <httplib.h>"),
    ("server/routes/a.cpp", '#include "server/jobs/runner.h"'),
    ("server/jobs/a.cpp", '#include "server/store/job_store.h"'),
    ("server/app.cpp", '#include "server/routes/routes.h"'),
    ("cli/main.cpp", '#include "server/app.h"'),
    ("core/format/gltf/a.cpp", "#include <tiny_gltf.h>"),
    ("core/mesh/a.cpp", "// std::getenv is not for core"),
    ("tests/core/a.cpp", '#include "core/mesh/mesh.h"'),
]


class IncludeDirections(unittest.TestCase):
    def faults(self, path, text):
        with tempfile.TemporaryDirectory() as root:
            file = pathlib.Path(root, path)
            file.parent.mkdir(parents=True)
            file.write_text("#pragma once\n" + text + "\n")
            with contextlib.redirect_stdout(io.StringIO()):
                return include_directions.main(root)

    def test_finds_each_forbidden_include(self):
        for path, text in FORBIDDEN:
            with self.subTest(path=path, text=text):
                self.assertEqual(self.faults(path, text), 1)

    def test_lets_each_allowed_include_pass(self):
        for path, text in ALLOWED:
            with self.subTest(path=path, text=text):
                self.assertEqual(self.faults(path, text), 0)

    def test_an_empty_tree_is_a_fault(self):
        with tempfile.TemporaryDirectory() as root, contextlib.redirect_stdout(io.StringIO()):
            self.assertEqual(include_directions.main(root), 1)


if __name__ == "__main__":
    unittest.main()
