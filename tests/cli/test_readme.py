import re
import unittest

from program import SCENES, ProgramTest


class MethodTable(ProgramTest):
    def test_the_readme_lists_the_methods_there_are(self):
        listed = re.findall(r"^\| `([a-z0-9]+)` \|", (SCENES.parent / "README.md").read_text().split("\n## Methods\n")[1], re.M)
        printed = [line.split()[0] for line in self.done("methods").stdout.split("\n\n")[0].splitlines()[1:]]
        self.assertEqual(listed, printed)


if __name__ == "__main__":
    unittest.main()
