import subprocess
import tempfile
import unittest
from pathlib import Path

CHECK = Path(__file__).resolve().parents[2] / "tools" / "check-references"
BIB = "@article{ward1992,\n  title = {A}\n}\n\n@misc{krivanek2005a,\n  title = {B}\n}\n"


def check(source, bib=BIB, name="src/a.h"):
    """Exit status and report of check-references on one source file."""
    with tempfile.TemporaryDirectory() as root:
        for path, text in {"docs/references.bib": bib, "README.md": "", name: source}.items():
            Path(root, path).parent.mkdir(exist_ok=True)
            Path(root, path).write_text(text, encoding="utf-8")
        done = subprocess.run([CHECK, root], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout.replace(f"{root}/", "")


class CheckReferences(unittest.TestCase):
    def test_accepts_known_works_in_every_form(self):
        status, report = check("// [Ward 1992] [Ward, Heckbert 1992] [Ward,\n  /// Heckbert 1992, section 3]\n"
                               "// [Krivanek 2005a; Ward 1992]\n")
        self.assertEqual(status, 0, report)

    def test_refuses_unknown_works_by_file_and_line(self):
        for source, line in (("\n// [Ward 1993]\n", 2), ("// [Krivanek 2005b]\n", 1), ("// [Ward,\n// Heckbert 1991]\n", 1),
                             ("// [Ward 1992; Nobody 2000]\n", 1), ("// [Arvo 1994, equation 2]\n", 1)):
            status, report = check(source)
            self.assertEqual(status, 1, source)
            self.assertTrue(report.startswith(f"src/a.h:{line}: "), report)

    def test_reads_the_readme_and_the_documentation(self):
        for name in ("README.md", "docs/theory.md"):
            self.assertEqual(check("[Nobody 2000]\n", name=name)[0], 1)

    def test_leaves_code_and_links_alone(self):
        status, report = check("int a[2000]; b[i + 1992]; // [the page](x.md) [Unreleased]\n")
        self.assertEqual(status, 0, report)

    def test_refuses_a_key_given_twice(self):
        status, report = check("", bib=BIB + BIB)
        self.assertEqual((status, report.count("twice")), (1, 2), report)


if __name__ == "__main__":
    unittest.main()
