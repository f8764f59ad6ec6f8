import subprocess
import tempfile
import unittest
from pathlib import Path

CHECK = Path(__file__).resolve().parents[2] / "tools" / "check-layers"


def check(files):
    """Exit status and report of check-layers on a tree of {name below isophote/: text}."""
    with tempfile.TemporaryDirectory() as root:
        for name, text in files.items():
            path = Path(root, "isophote", name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        done = subprocess.run([CHECK, root], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout.replace(f"{root}/isophote/", "")


class CheckLayers(unittest.TestCase):
    def refused(self, files, start):
        status, report = check(files)
        self.assertEqual((status, report.count("\n")), (1, 1), report)
        self.assertTrue(report.startswith(start), report)

    def test_accepts_arrows_of_the_picture_over_any_distance(self):
        status, report = check({
            "core/vec.h": "#pragma once\n#include <cmath>\n",
            "cache/record.h": '#include "isophote/core/vec.h"\n',
            "trace/embree.cpp": '#include <embree3/rtcore.h>\n#include "isophote/core/vec.h"\n',
            "integrate/rounds.h": '#include "isophote/cache/record.h"\n',
            "apps/main.cpp": '#include <CLI/CLI.hpp>\n#include <oneapi/tbb.h>\n#include "isophote/integrate/rounds.h"\n',
        })
        self.assertEqual(status, 0, report)

    def test_refuses_an_arrow_upwards(self):
        self.refused({"core/a.h": '\n#include "isophote/cache/b.h"\n', "cache/b.h": ""}, 'core/a.h:2: "isophote/cache/b.h"')

    def test_refuses_an_arrow_between_the_arms(self):
        self.refused({"cache/a.h": '#include "isophote/scene/b.h"\n', "scene/b.h": ""}, "cache/a.h:1:")
        self.refused({"trace/a.h": '#include "isophote/cache/b.h"\n', "cache/b.h": ""}, "trace/a.h:1:")

    def test_refuses_foreign_headers_in_the_caching_arm(self):
        for header in ("fmt/format.h", "unistd.h", "toml++/toml.h"):
            self.refused({"validity/a.cpp": f"#include <{header}>\n"}, f"validity/a.cpp:1: <{header}>")

    def test_refuses_reserved_headers_elsewhere(self):
        for header in ("embree3/rtcore.h", "CLI/CLI.hpp", "tbb/parallel_for.h", "oneapi/tbb/parallel_for.h"):
            self.refused({"integrate/a.cpp": f"#  include <{header}>\n"}, f"integrate/a.cpp:1: <{header}>")

    def test_refuses_what_is_not_there(self):
        self.refused({"core/a.h": '#include "isophote/core/b.h"\n'}, "core/a.h:1:")
        self.refused({"core/a.h": '#include "b.h"\n', "core/b.h": ""}, "core/a.h:1:")
        self.refused({"misc/a.h": ""}, "misc/a.h:1: misc is not a folder")

    def test_refuses_rings_of_files(self):
        self.refused({"core/a.h": '#include "isophote/core/b.h"\n', "core/b.h": '#include "isophote/core/a.h"\n'},
                     "core/a.h:1: includes itself: isophote/core/a.h -> isophote/core/b.h -> isophote/core/a.h")

    def test_refuses_an_empty_tree(self):
        self.assertEqual(check({})[0], 1)


if __name__ == "__main__":
    unittest.main()
