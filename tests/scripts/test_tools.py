#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Proves that the checks of tools/ find what is planted in a small tree, and nothing in a clean one.

Not tested here: install_dependencies.sh beyond its refusals, run.sh and test.sh, which need a whole machine.
"""
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
LICENCE_LINE = "// SPDX-License-Identifier: BSD-3-Clause\n"
SCRIPT_LICENCE_LINE = "# SPDX-License-Identifier: BSD-3-Clause\n"
ROOMS = SCRIPT_LICENCE_LINE + "set(rooms core laws\n    engine  # the order counts\n    io)\n"


class Tree(unittest.TestCase):
    """A clean project of four rooms in a folder of its own."""

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        self.write("src/dem4grm/CMakeLists.txt", ROOMS)
        self.write("src/dem4grm/core/vec3.hpp", LICENCE_LINE + "#pragma once\nstruct Vec3 {\n  double x;\n};\n")
        self.write("src/dem4grm/engine/step.cpp",
                   LICENCE_LINE + '#include "dem4grm/core/vec3.hpp"\n#include "dem4grm/version.hpp"\n'
                   "#include <vector>\n\ndouble step(Vec3 v) { return v.x; }\n")
        self.write("apps/dem4grm/main.cpp", LICENCE_LINE + '#include "dem4grm/io/any.hpp"\nint main() { return 0; }\n')

    def write(self, name: str, text: str) -> None:
        file = self.root / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")

    def run_tool(self, tool: str, *options: str) -> tuple[int, str]:
        answer = subprocess.run([ROOT / "tools" / tool, "--root", self.root, *options],
                                capture_output=True, text=True, check=False)
        self.assertEqual(answer.stderr, "")
        return answer.returncode, answer.stdout

    def assert_finds(self, tool: str, *pieces: str) -> None:
        status, text = self.run_tool(tool)
        self.assertEqual(status, 1, text)
        for piece in pieces:
            self.assertIn(piece, text)
        self.assertIn(" 1 violations", text)

    def assert_clean(self, tool: str) -> None:
        status, text = self.run_tool(tool)
        self.assertEqual((status, " 0 violations" in text), (0, True), text)


class Rooms(Tree):
    tool = "check_rooms.py"

    def test_clean_tree_passes(self) -> None:
        self.assert_clean(self.tool)

    def test_include_from_a_later_room_is_found_with_its_line(self) -> None:
        self.write("src/dem4grm/core/a.hpp", LICENCE_LINE + '/* two\n   lines */\n #  include <dem4grm/io/case.hpp>\n')
        self.assert_finds(self.tool, "src/dem4grm/core/a.hpp:4: ", "'core' comes before 'io'")

    def test_unknown_room_is_found(self) -> None:
        self.write("src/dem4grm/io/a.cpp", LICENCE_LINE + '#include "dem4grm/cellar/a.hpp"\n')
        self.assert_finds(self.tool, "src/dem4grm/io/a.cpp:2: ", "unknown room 'cellar'")

    def test_file_outside_the_rooms_is_found(self) -> None:
        self.write("src/dem4grm/cellar/a.cpp", LICENCE_LINE)
        self.assert_finds(self.tool, "src/dem4grm/cellar/a.cpp:1: lies in no room")

    def test_file_beside_the_rooms_is_found(self) -> None:
        self.write("src/dem4grm/a.cpp", LICENCE_LINE)
        self.assert_finds(self.tool, "src/dem4grm/a.cpp:1: lies in no room")

    def test_include_without_a_room_is_found(self) -> None:
        self.write("src/dem4grm/io/a.cpp", LICENCE_LINE + '#include "neighbour.hpp"\n')
        self.assert_finds(self.tool, 'own headers are written "dem4grm/<room>/..."')

    def test_include_in_a_comment_counts_for_nothing(self) -> None:
        self.write("src/dem4grm/core/a.hpp",
                   LICENCE_LINE + '// #include "dem4grm/io/a.hpp"\n/*\n#include "dem4grm/io/a.hpp"\n*/\n')
        self.assert_clean(self.tool)

    def test_list_of_rooms_must_exist(self) -> None:
        self.write("src/dem4grm/CMakeLists.txt", "# set(rooms core)\n")
        answer = subprocess.run([ROOT / "tools" / self.tool, "--root", self.root],
                                capture_output=True, text=True, check=False)
        self.assertEqual(answer.returncode, 1)
        self.assertIn("no set(rooms", answer.stderr)


class Size(Tree):
    tool = "check_size.py"
    long_body = "{\n" + "  ++n;\n" * 125 + "}"

    def test_clean_tree_passes(self) -> None:
        self.assert_clean(self.tool)

    def test_long_file_is_found_and_a_longish_one_remarked(self) -> None:
        self.write("tests/unit/a.cpp", LICENCE_LINE + "// text\n" * 499)
        status, text = self.run_tool(self.tool)
        self.assertEqual(status, 0, text)
        self.assertIn("tests/unit/a.cpp:1: remark: 500 lines", text)
        self.write("tests/unit/a.cpp", LICENCE_LINE + "// text\n" * 500)
        self.assert_finds(self.tool, "tests/unit/a.cpp:1: 501 lines, at most 500")

    def test_function_limit_is_exact(self) -> None:
        for extra, status_wanted in ((118, 0), (119, 1)):
            self.write("src/dem4grm/io/a.cpp", LICENCE_LINE + "void f(int n) {\n" + "  ++n;\n" * extra + "}\n")
            self.assertEqual(self.run_tool(self.tool)[0], status_wanted, extra)

    def test_long_functions_of_many_forms_are_found(self) -> None:
        heads = {
            "free": "int f(int n) ",
            "template with a class in its head": "template <class T, typename U = struct V>\nT f(T n)\n",
            "member": "struct A {\n public:\n  void f(int n) const noexcept ",
            "constructor with a list": "struct A {\n  explicit A(double w) : w_{w}, list_{1, 2}, n(3) ",
            "trailing return type": "auto f(std::vector<int>& n) -> std::pair<int, int> ",
            "operator": "bool operator<(A n, A m) ",
            "lambda at file level": "const auto f = [](int n) ",
            "nested namespace": "namespace dem::detail {\ninline int f(int n = {}) ",
            "test macro": "TEST(Step, keeps_energy) ",
            "constraint": "template <int W>\n  requires (W > 0)\nvoid f(int n) ",
        }
        for form, head in heads.items():
            with self.subTest(form):
                self.write("src/dem4grm/io/a.cpp", LICENCE_LINE + head + self.long_body + "\n" * 3)
                self.assert_finds(self.tool, "function of ")

    def test_long_tables_types_and_literals_are_not_functions(self) -> None:
        rows = '  {"}", 1.0, \'{\'},  // {\n' * 125
        forms = {
            "table": "const std::array<Row, 125> k_table = {{\n" + rows + "}};",
            "table without an equals sign": "inline const std::vector<Row> k_table{\n" + rows + "};",
            "class": "class A : public B<C(int)> {\n" + "  int f() { return 1'000; }\n" * 125 + "};",
            "aligned struct": "struct alignas(64) A {\n" + "  double x = 0;\n" * 125 + "};",
            "raw text": 'const char* k_page = R"page(\nvoid f(int n) {\n' + '  "(\n' * 125 + '})page";',
            "macro": "#define DEM_EACH(n) \\\n  void f(int n) { \\\n" + "  ++n; \\\n" * 125 + "  }",
        }
        for form, text in forms.items():
            with self.subTest(form):
                self.write("src/dem4grm/io/a.cpp", LICENCE_LINE + text + "\n")
                self.assert_clean(self.tool)

    def test_missing_licence_is_found_in_each_kind_of_source(self) -> None:
        for name in ("src/dem4grm/io/a.hpp", "tools/a.py", "cmake/A.cmake", "web/a.ts", "CMakeLists.txt"):
            with self.subTest(name):
                self.write(name, "\n")
                self.assert_finds(self.tool, f"{name}:1: ")
                (self.root / name).unlink()

    def test_script_without_an_ending_is_known_by_its_first_line(self) -> None:
        self.write("tools/a", "#!/bin/sh\n")
        self.assert_finds(self.tool, "tools/a:1: ")
        self.write("tools/a", "#!/bin/sh\n" + SCRIPT_LICENCE_LINE)
        self.assert_clean(self.tool)

    def test_notes_of_unfinished_work_are_found(self) -> None:
        for word in ("TO" + "DO", "FIX" + "ME", "XX" + "X"):
            with self.subTest(word):
                self.write("docs/a.md", f"text\n{word}: later\n")
                self.assert_finds(self.tool, "docs/a.md:2: ")
        self.write("docs/a.md", "mktemp /tmp/" + "X" * 6 + "\n")
        self.assert_clean(self.tool)

    def test_built_folders_and_data_are_left_alone(self) -> None:
        self.write("build/release/a.cpp", "int a;\n")
        (self.root / "cases.h5").write_bytes(b"\x89HDF\xff\xfe")
        self.assert_clean(self.tool)

    def test_exception_needs_a_reason_and_a_need(self) -> None:
        self.write("src/dem4grm/io/a.cpp", LICENCE_LINE + "// text\n" * 600)
        self.write("tools/size_exceptions.txt", "# rule path reason\nfile-length src/dem4grm/io/a.cpp one table\n")
        self.assert_clean(self.tool)
        self.write("src/dem4grm/io/a.cpp", LICENCE_LINE)
        self.assert_finds(self.tool, "nothing needs 'file-length src/dem4grm/io/a.cpp'")
        self.write("tools/size_exceptions.txt", "file-length src/dem4grm/io/a.cpp\n")
        self.assert_finds(self.tool, "tools/size_exceptions.txt:1: wanted")


class Headers(Tree):
    tool = "check_headers.py"

    def test_clean_tree_passes(self) -> None:
        self.assert_clean(self.tool)

    def test_header_that_leans_on_its_includer_is_found(self) -> None:
        self.write("src/dem4grm/core/a.hpp", LICENCE_LINE + "#pragma once\ninline std::vector<int> f() { return {}; }\n")
        self.assert_finds(self.tool, "src/dem4grm/core/a.hpp:1: does not compile alone")

    def test_header_without_a_guard_is_found(self) -> None:
        self.write("tests/support/a.hpp", LICENCE_LINE + "struct A {};\n")
        self.assert_finds(self.tool, "tests/support/a.hpp:1: does not compile alone")

    def test_generated_header_may_be_included(self) -> None:
        self.write("cmake/WriteVersion.cmake", SCRIPT_LICENCE_LINE + 'set(text "const char* k_commit")\n')
        self.write("src/dem4grm/io/a.hpp", LICENCE_LINE + '#pragma once\n#include "dem4grm/version.hpp"\n'
                   "inline const char* f() { return dem::k_commit; }\n")
        self.assert_clean(self.tool)


@unittest.skipUnless(os.uname().machine == "x86_64", "the instructions are those of x86-64")
class Instructions(unittest.TestCase):
    tool = ROOT / "tools" / "instructions.py"

    def compiled(self, source: str, *flags: str, call: tuple[str, ...]) -> tuple[int, str]:
        """Exit code and output of the tool on a compiled text; "FILE" in the call is the object file."""
        with tempfile.TemporaryDirectory() as folder:
            text, binary = Path(folder) / "part.c", Path(folder) / "part.o"
            text.write_text(source, encoding="utf-8")
            subprocess.run(["gcc", "-O3", *flags, "-c", text, "-o", binary], check=True)
            words = [str(binary) if word == "FILE" else word for word in call]
            answer = subprocess.run([self.tool, *words], capture_output=True, text=True, check=False)
            return answer.returncode, answer.stdout

    def fused(self, contract: str) -> tuple[int, str]:
        return self.compiled("double sum(double a, double b, double c) { return a * b + c; }\n", "-mfma", contract,
                             call=("fused", "FILE"))

    def test_a_fused_instruction_is_found_and_its_function_named(self) -> None:
        code, text = self.fused("-ffp-contract=fast")
        self.assertEqual(code, 1)
        self.assertIn("fused multiply-add in sum", text)

    def test_without_contraction_there_is_none(self) -> None:
        self.assertEqual(self.fused("-ffp-contract=off")[0], 0)

    def lanes(self, *flags: str, name: str = "many") -> tuple[int, str]:
        body = "".join(f"y = y * x[k] + {k + 1}.5 * z; z = z - y * y;" for k in range(40))
        return self.compiled(f"void many(double* x) {{ for (int k = 0; k < 64; ++k) {{ double y = x[k], z = y * y; "
                             f"{body.replace('x[k]', 'y')} x[k] = z; }} }}\n", *flags, call=("lanes", "FILE", name))

    def test_a_loop_that_is_not_vectorised_is_found(self) -> None:
        self.assertEqual(self.lanes()[0], 0)
        code, text = self.lanes("-fno-tree-vectorize")
        self.assertEqual(code, 1)
        self.assertIn("operations on single numbers, 0 on vectors in many", text)

    def test_a_function_that_is_not_there_is_no_success(self) -> None:
        code, text = self.lanes(name="absent")
        self.assertEqual(code, 1)
        self.assertIn("'absent'", text)

    def test_code_outside_its_namespace_is_found(self) -> None:
        own = "int mine_first(void) { return 1; }\nstatic int helper(int x) { return x; }\nint mine_second(void) { return helper(2); }\n"
        self.assertEqual(self.compiled(own, call=("own", "mine_", "FILE"))[0], 0)
        code, text = self.compiled(own + "__attribute__((weak)) int shared(void) { return 3; }\n", call=("own", "mine_", "FILE"))
        self.assertEqual(code, 1)
        self.assertIn("part.o: shared", text)

    def test_a_missing_file_or_a_wrong_call_is_no_success(self) -> None:
        for code, words in ((2, ("fused", "no_such_file.o")), (64, ()), (64, ("lanes", "a.o"))):
            answer = subprocess.run([self.tool, *words], capture_output=True, text=True, check=False)
            self.assertEqual(answer.returncode, code)


class ShellScripts(unittest.TestCase):
    scripts = ("run.sh", "test.sh", "tools/install_dependencies.sh", ".ci/run")

    def test_scripts_are_executable_and_parse(self) -> None:
        for name in self.scripts:
            with self.subTest(name):
                self.assertTrue(os.access(ROOT / name, os.X_OK))
                subprocess.run(["bash", "-n", ROOT / name], check=True)

    def test_wrong_usage_is_refused_with_64(self) -> None:
        for command in (["tools/install_dependencies.sh"], ["tools/install_dependencies.sh", "everything"],
                        ["test.sh", "everything"]):
            with self.subTest(command):
                answer = subprocess.run([ROOT / command[0], *command[1:]], capture_output=True, text=True, check=False)
                self.assertEqual(answer.returncode, 64)
                self.assertIn("usage", answer.stderr)

    def test_test_group_holds_the_build_group(self) -> None:
        groups = [set(subprocess.run([ROOT / "tools/install_dependencies.sh", "--list", group],
                                     capture_output=True, text=True, check=True).stdout.split())
                  for group in ("build", "test")]
        self.assertIn("cmake", groups[0])
        self.assertLess(groups[0], groups[1])


if __name__ == "__main__":
    unittest.main()
