"""Rules of CONTRIBUTING.md about the layout of sources, each checked over the whole checkout and on planted faults:

sizes    no function, lambda or constructor has more than 60 lines or 6 parameters;
names    no name is defined in the anonymous namespaces of two files of a target, which are compiled as one;
threads  nothing is kept a thread but by solver/base/scratch.h;
lists    every pattern of tests/dev_only_tests.txt is that of a test.

Usage: sources_test.py ROOT sizes|names|threads|lists
"""

import fnmatch
import os
import re
import sys

from cpp_outline import Outline, tokens_of

FOLDERS = ["solver", "mesh", "display", "apps", "experiments", "tests", "examples", "python"]
MOST_LINES, MOST_PARAMETERS = 60, 6

# What is compiled together: a folder with those in it that have no target of their own. A program of tests/fuzz is one file.
TARGETS = ["solver/base", "solver/geometry", "solver/scene", "solver/visibility", "solver/transport", "mesh",
           "display/viewer", "display", "apps"]
ALONE = "tests/fuzz/"
MACROS = ("TEST", "INSTANTIATE")  # of GoogleTest, which look like functions

THREADS_HOME = "solver/base/scratch.h"
DEV_ONLY = "tests/dev_only_tests.txt"


def sources_below(root):
    """The paths and texts of all sources, in a fixed order."""
    files = {}
    for folder in FOLDERS:
        for where, _, names in os.walk(os.path.join(root, folder)):
            for name in names:
                if name.endswith((".h", ".cpp")):
                    path = os.path.join(where, name)
                    with open(path, encoding="utf-8") as file:
                        files[os.path.relpath(path, root)] = file.read()
    return dict(sorted(files.items()))


def find_too_large(files):
    faults = []
    for path, text in files.items():
        for function in Outline(text).functions:
            if function.lines <= MOST_LINES and function.parameters <= MOST_PARAMETERS:
                continue
            faults.append(f"{path}:{function.line}: {function.name} has {function.lines} lines and "
                          f"{function.parameters} parameters, not {MOST_LINES} and {MOST_PARAMETERS} at most")
    return faults


def target_of(path):
    for target in TARGETS:
        if path.startswith(target + "/"):
            return target
    return path if path.startswith(ALONE) else os.path.dirname(path)


def go_together(a, b):
    """Whether the compiler takes both definitions of a name in one file: overloads, and equal aliases."""
    if a.kind != b.kind or not a.kind:
        return False
    return (a.meaning == b.meaning) == (a.kind == "alias")


def find_clashes(files):
    faults, known = [], {}
    for path, text in files.items():
        for hidden in Outline(text).hidden:
            if hidden.name.startswith(MACROS):
                continue
            before = known.setdefault((target_of(path), hidden.name), [])
            for other_path, other in before:
                if other_path != path and not go_together(other, hidden):
                    faults.append(f"{path}:{hidden.line}: {hidden.name} is defined in {other_path}:{other.line} too")
            before.append((path, hidden))
    return faults


def find_kept(files):
    return [f"{path}:{token.line}: thread_local; only {THREADS_HOME} may keep anything a thread"
            for path, text in files.items() if path != THREADS_HOME
            for token in tokens_of(text) if token.text == "thread_local"]


def find_stale(files, patterns, field_cases):
    """Patterns of GoogleTest that name no test. A case of tests/field is named after its file."""
    tests = ["Field." + name.replace("-", "_") for name in field_cases]
    for text in files.values():
        tests += [".".join(names) for names in re.findall(r"^TEST(?:_F|_P)?\((\w+),\s*(\w+)\)", text, re.MULTILINE)]
    return [f"{DEV_ONLY}: {pattern} is no test" for pattern in patterns if not fnmatch.filter(tests, pattern)]


def read_dev_only(root):
    with open(os.path.join(root, DEV_ONLY), encoding="utf-8") as file:
        patterns = [line.strip() for line in file if line.strip() and not line.startswith("#")]
    cases = [name.removesuffix(".json") for name in os.listdir(os.path.join(root, "tests/field")) if name.endswith(".json")]
    return patterns, cases


def expect(what, found, wanted, planted):
    if len(found) != wanted:
        raise SystemExit(f"{what}: {len(found)} faults found in what was planted, not {wanted}:\n{planted}\n{found}")


def long_function(head, lines):
    return head + " {\n" + "  Work();\n" * (lines - 2) + "}\n"


def plant_sizes():
    many = "int a, int b, std::map<int, int> c, int (*d)(int, int), int e = f(1, 2), int g = {1}, int h"
    six = "int a, std::array<int, 6> b, const std::function<void(int, int)>& c, int d = F(1, 2), int e = {}, G* g"
    for head, wanted in [
        ("void F()", 1), ("int C::F(int a) const", 1), ("C::C(int a) : a_(a), b_{a, 2}, Base<int, 3>(a)", 1),
        ("template <class T, class U>\n  requires(sizeof(T) > 2)\nauto F(T t) -> std::vector<T>", 1),
        ("bool operator()(int a) const", 1), ("TEST(A, B)", 1),
    ]:
        for text in (long_function(head, MOST_LINES + 1), "namespace a { namespace {\n" + long_function(head, 61) + "} }"):
            expect("sizes", find_too_large({"a.cpp": text}), wanted, text)
        short = long_function(head, MOST_LINES - head.count("\n"))
        expect("sizes", find_too_large({"a.cpp": short}), 0, short)
    for text, wanted in [
        (f"void F({many});", 1), (f"void F({many}) {{}}", 1), (f"struct A {{ explicit A({many}) : a(1) {{}} }};", 1),
        (f"class A {{ public: A({many}); ~A(); }};", 1), (f"void F() {{ auto f = [&]({many}) {{ return 1; }}; }}", 1),
        (f"auto f = [x = 1]({many}) mutable -> int {{ return 1; }};", 1), (f"A operator+({many});", 1),
        (f"void F() {{ struct B {{ void G({many}) {{}} }}; }}", 1), (f"template <> int A<1, 2>::F({many}) {{}}", 1),
        ("void F() { G(a, b, c, d, e, f, g); }", 0), ("A a{1, 2, 3, 4, 5, 6, 7};", 0), ("A a = F(1, 2, 3, 4, 5, 6, 7);", 0),
        (f"void F({six}) {{}}", 0), (f"// void F({many});", 0), (f'const char* a = "void F({many}) {{";', 0),
        ("F(void);", 0), ("int a[7]; auto g = [](int) { return a[1]; };", 0),
    ]:
        expect("sizes", find_too_large({"a.cpp": text}), wanted, text)
    text = "void F() {\n  auto f = [&] {\n" + "    Work();\n" * 60 + "  };\n}\n"
    expect("sizes", find_too_large({"a.cpp": text}), 2, text)


def plant_names():
    def hide(text):
        return "namespace penumbra {\nnamespace {\n" + text + "\n}  // namespace\nint Open() { return 1; }\n}"

    for first, second, wanted in [
        ("constexpr int kA = 1;", "const double kA = 2;", 1), ("constexpr int kA = 1, kB = F(1, 2), kC = 3;", "int kC;", 1),
        ("struct A {};", "class A { int b; };", 1), ("enum class A { kB };", "using A = int;", 1),
        ("int F(int a) { return a; }", "int F(int b) { return b; }", 1), ("int A[2] = {1, 2};", "void A() {}", 1),
        ("std::array<int, 2> a{1, 2};", "int a;", 1),
        ("int F(int a) { return a; }", "int F(const A& a) { return a.b; }", 0), ("using A = int;", "using A = int;", 0),
        ("struct A { int b; void F() {} };", "struct B { int b; void F() {} };", 0), ("", "", 0),
        ("void F() { int a = 1; }", "void G() { int a = 1; }", 0), ("enum class A { kB };", "enum class C { kB };", 0),
    ]:
        both = {"mesh/a/a.cpp": hide(first), "mesh/b/b.cpp": hide(second)}
        expect("names", find_clashes(both), wanted, both)
        apart = {"mesh/a.cpp": hide(first), "display/b.cpp": hide(second)}
        expect("names", find_clashes(apart), 0, apart)


def plant_threads():
    kept = "int F() {\n  thread_local int a = 0;\n  return ++a;\n}\n"
    expect("threads", find_kept({"mesh/a.cpp": kept}), 1, kept)
    expect("threads", find_kept({THREADS_HOME: kept, "mesh/a.cpp": "// thread_local\n"}), 0, kept)


def plant_lists():
    files = {"a.cpp": "TEST(A, BCd) {}\nTEST_F(E,\n       F) {}\n", "b.cpp": "TEST_P(G,\n       H) {}\n"}
    for pattern, wanted in [("A.BCd", 0), ("A.B*", 0), ("A.B", 1), ("E.F", 0), ("G.H", 0), ("Field.1_a", 0), ("Field.1-a", 1)]:
        expect("lists", find_stale(files, [pattern], ["1-a"]), wanted, pattern)


def main():
    root, rule = sys.argv[1:]
    files = sources_below(root)
    if not files:
        raise SystemExit(f"no sources below {root}")
    if rule == "sizes":
        plant_sizes()
        faults = find_too_large(files)
    elif rule == "names":
        plant_names()
        faults = find_clashes(files)
    elif rule == "threads":
        plant_threads()
        faults = find_kept(files)
    elif rule == "lists":
        plant_lists()
        faults = find_stale(files, *read_dev_only(root))
    else:
        raise SystemExit(__doc__)
    print("\n".join(faults))
    print(f"{len(files)} sources looked at, {len(faults)} faults")
    return 1 if faults else 0


sys.exit(main())
