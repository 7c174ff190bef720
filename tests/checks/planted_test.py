#!/usr/bin/env python3
"""The checks themselves: each finds a violation that is planted for it, and passes what is right.

Usage: planted_test.py CLANG_FORMAT.
"""
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

import assets
import format as format_check
import layers
import shape

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "tools"))
import check_skips  # noqa: E402
import tidy  # noqa: E402


class Planted(unittest.TestCase):
    """A tree of its own for each test."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        return path


class Layers(Planted):
    def reasons(self, name, *headers):
        self.write(name, "".join(f"#include {header}\n" for header in headers))
        return list(layers.violations(self.root))

    def test_a_sibling_may_not_be_included(self):
        found = self.reasons("tracker/a.cpp", '"tracker/a.h"', '"renderer/image.h"')
        self.assertEqual(
            found, ["tracker/a.cpp:2: includes renderer/image.h: tracker does not know renderer"])

    def test_a_lower_layer_does_not_know_a_higher_one(self):
        for name, header in [("core/a.h", '"tracker/a.h"'), ("renderer/gl/a.h", '"app/a.h"'),
                             ("cluster/a.cpp", '"simulator/a.h"')]:
            with self.subTest(name):
                self.assertEqual(len(self.reasons(name, header)), 1)
                (self.root / name).unlink()

    def test_a_higher_layer_knows_all_below(self):
        self.assertEqual(self.reasons("app/main.cpp", '"core/a.h"', '"tracker/a.h"',
                                      '"cluster/a.h"', '"renderer/a.h"', '"simulator/a.h"'), [])

    def test_libraries_are_private_to_their_folder(self):
        for name, header in [
                ("core/wall.cpp", "<opencv2/core.hpp>"), ("app/main.cpp", "<GLFW/glfw3.h>"),
                ("simulator/a.cpp", "<glm/glm.hpp>"), ("tracker/a.cpp", "<assimp/scene.h>"),
                ("core/log.h", "<spdlog/spdlog.h>"), ("app/a.cpp", "<toml++/toml.h>"),
                ("renderer/a.cpp", "<CLI/CLI.hpp>"), ("simulator/a.cpp", "<epoxy/gl.h>"),
                ("app/wiimote.cpp", "<hidapi.h>"), ("tracker/a.cpp", "<hidapi/hidapi.h>"),
                ("tracker/wiimote/live.cpp", "<sdbus-c++/sdbus-c++.h>"),
                ("app/a.cpp", '"core/internal/toml_table.h"')]:
            with self.subTest(f"{header} in {name}"):
                self.assertEqual(len(self.reasons(name, header)), 1)
                (self.root / name).unlink()

    def test_libraries_are_at_home_in_their_folder_and_eigen_everywhere(self):
        for name, header in [
                ("tracker/a.cpp", "<opencv2/core.hpp>"), ("renderer/a.cpp", "<GLFW/glfw3.h>"),
                ("core/internal/a.h", "<toml++/toml.h>"), ("core/log.cpp", "<spdlog/spdlog.h>"),
                ("app/main.cpp", "<CLI/CLI.hpp>"), ("core/a.h", "<Eigen/Core>"),
                ("tracker/wiimote/hidapi_bus.cpp", "<hidapi.h>")]:
            with self.subTest(f"{header} in {name}"):
                self.assertEqual(self.reasons(name, header), [])

    def test_a_library_without_a_row_may_not_be_included_and_the_system_may(self):
        for header in ["<boost/format.hpp>", "<libusb.h>", '"json.hpp"', '"tests/a.h"']:
            with self.subTest(header):
                self.assertEqual(len(self.reasons("app/a.cpp", header)), 1)
        self.assertEqual(self.reasons("app/a.cpp", "<vector>", "<sys/mman.h>", "<unistd.h>"), [])

    def test_a_path_may_not_lead_upwards(self):
        for header in ['"../renderer/a.h"', '"tracker/../renderer/a.h"']:
            with self.subTest(header):
                self.assertEqual(self.reasons("tracker/a.cpp", header), [
                    f"tracker/a.cpp:1: includes {header[1:-1]}: write the path from the root"])

    def test_the_emulated_wiimote_and_what_reads_it_share_no_code(self):
        driver = ["report", "commands", "session", "reader"]
        emulator = ["emulator", "emulator_camera", "emulator_bus"]
        for name, others in [("emulator.cpp", driver), ("emulator_link.h", driver),
                             ("uhid_device.cpp", driver), ("report.cpp", emulator),
                             ("session.h", emulator)]:
            for other in others:
                header = f'"tracker/wiimote/{other}.h"'
                with self.subTest(f"{header} in {name}"):
                    self.assertEqual(len(self.reasons(f"tracker/wiimote/{name}", header)), 1)
                    (self.root / "tracker/wiimote" / name).unlink()

    def test_the_device_is_where_the_emulated_wiimote_and_what_reads_it_meet(self):
        device = '"tracker/wiimote/hid_device.h"'
        self.assertEqual(self.reasons("tracker/wiimote/emulator_bus.h", device,
                                      '"tracker/wiimote/emulator_device.h"', '"core/clock.h"'), [])
        self.assertEqual(self.reasons("tracker/wiimote/reader.h", device,
                                      '"tracker/wiimote/session.h"'), [])
        self.assertEqual(self.reasons("simulator/emulated_room.h",
                                      '"tracker/wiimote/emulator_bus.h"'), [])


class Shape(Planted):
    def test_a_line_of_101_columns_is_found_and_one_of_100_is_not(self):
        self.write("core/a.cpp", "a" * 100 + "\n" + "b" * 101 + "\n")
        self.assertEqual(list(shape.breaches(self.root)),
                         ["core/a.cpp:2: 101 columns; at most 100"])

    def test_columns_are_characters_not_bytes(self):
        self.write("core/a.cpp", "ø" * 100 + "\n")
        self.assertEqual(list(shape.breaches(self.root)), [])

    def test_a_file_of_501_lines_is_found(self):
        self.write("core/a.cpp", "\n" * 501)
        self.write("core/b.cpp", "\n" * 500)
        self.assertEqual(list(shape.breaches(self.root)),
                         ["core/a.cpp: 501 lines; at most 500: split it"])

    def test_a_header_without_a_guard_is_found(self):
        self.write("core/a.h", "// What it is for.\n")
        self.write("core/b.h", "// What it is for.\n#pragma once\n")
        self.assertEqual(list(shape.breaches(self.root)),
                         ["core/a.h: no #pragma once: it cannot be included twice"])

    def test_functions_are_measured(self):
        lines = ["namespace a {", "", "int one() { return 1; }", "", "void four(int b,",
                 "          int c) {", "  b = c;", "}", "", "struct D {", "  int e;", "};", "", "}"]
        self.assertEqual([size for _, size in shape.function_sizes(lines)], [4])


class Tidy(Planted):
    def key(self):
        return tidy.key_of(self.root, Path("core/a.cpp"), "c++ -c", b"settings")

    def test_a_source_is_looked_at_again_when_a_header_behind_a_header_changes(self):
        self.write("core/a.cpp", '#include "core/a.h"\n')
        self.write("core/a.h", '#include "core/b.h"\n')
        self.write("core/b.h", "int b();\n")
        before = self.key()
        self.assertEqual(self.key(), before)
        self.write("core/b.h", "int c();\n")
        self.assertNotEqual(self.key(), before)

    def test_headers_that_include_each_other_come_to_an_end(self):
        self.write("core/a.cpp", '#include "core/a.h"\n')
        self.write("core/a.h", '#include "core/b.h"\n')
        self.write("core/b.h", '#include "core/a.h"\n')
        self.assertEqual(len(tidy.texts_behind(self.root, Path("core/a.cpp"))), 3)


    def test_sources_of_one_target_that_are_compiled_alike_are_looked_at_together(self):
        def command(source, target, more=""):
            output = f"a/CMakeFiles/{target}.dir/{source}.o"
            return f"c++ -I/x{more} -MD -MT {output} -MF {output}.d -o {output} -c {source}"
        waiting = [(Path(source), command(source, *of)) for source, *of in (
            ("a/1.cpp", "one"), ("a/2.cpp", "one"), ("a/3.cpp", "other"), ("b/4.cpp", "one"),
            ("a/5.cpp", "one", " -DY"))]
        self.assertEqual(tidy.batches_of(waiting),
                         [([Path("a/1.cpp"), Path("a/2.cpp"), Path("b/4.cpp")], ("-I/x",)),
                          ([Path("a/3.cpp")], ("-I/x",)),
                          ([Path("a/5.cpp")], ("-I/x", "-DY"))])

    def test_a_line_of_joined_sources_is_a_line_of_one_of_them(self):
        self.write("core/a.cpp", "#include <a>\nint a();")
        self.write("core/c.cpp", "#include <a>\nint c();\n#include <a>\n")
        sources = [Path("core/a.cpp"), Path("core/c.cpp")]
        text, places = tidy.joined(self.root, sources)
        # An include that an earlier source has is left out, one that is twice in its own is not.
        self.assertEqual(text.splitlines(),
                         ["#include <a>", "int a();", "", "int c();", "#include <a>"])
        self.assertEqual(places[3], (Path("core/c.cpp"), 2))


class Format(Planted):
    def test_a_source_that_is_not_formatted_is_found(self):
        shutil.copy(ROOT / ".clang-format", self.root)
        self.write("core/a.cpp", "int  a( ) ;\n")
        self.assertIn("core/a.cpp:1", format_check.unformatted(self.root, CLANG_FORMAT))
        self.write("core/a.cpp", "int a();\n")
        self.assertEqual(format_check.unformatted(self.root, CLANG_FORMAT), "")


class Assets(Planted):
    def test_a_model_that_its_script_would_not_make_is_found(self):
        for name in ["same", "changed", "new"]:
            self.write(f"made/lab/{name}.glb", name)
        self.write("assets/lab/same.glb", "same")
        self.write("assets/lab/changed.glb", "by hand")
        self.write("assets/wiimote/eeprom.bin", "of no script")
        self.assertEqual(assets.differing(self.root / "made", self.root / "assets"),
                         [Path("lab/changed.glb"), Path("lab/new.glb")])


class Skips(Planted):
    def status(self, skips):
        junit = self.write("junit.xml", '<testsuite><testcase name="a.Runs" status="run"/>'
                           '<testcase name="a.Skips" status="notrun"><skipped/></testcase>'
                           '<testcase name="a.Off" status="disabled"/></testsuite>')
        return check_skips.main(junit, self.write("skips.txt", skips))

    def test_a_skip_fails_unless_it_is_listed(self):
        self.assertEqual(self.status("# nothing\n"), 1)
        self.assertEqual(self.status("a.Skips no camera here\n"), 1)
        self.assertEqual(self.status("a.Skips no camera here\na.O* too slow\n"), 0)

    def test_a_listed_skip_needs_a_reason(self):
        with self.assertRaisesRegex(SystemExit, "skips.txt:1: a.Skips: a skip needs its reason"):
            self.status("a.Skips\n")


if __name__ == "__main__":
    CLANG_FORMAT = sys.argv.pop()
    unittest.main()
