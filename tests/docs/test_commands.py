"""scripts/check-docs finds the commands of pages, runs them in a clone, and stops where one fails."""

import subprocess
import tempfile
import unittest
from pathlib import Path

CHECK_DOCS = Path(__file__).resolve().parents[2] / "scripts/check-docs"

PAGE = """# A page

```sh
heightlight --version > version.txt   # kept for the next block
pwd | grep heightlight
```

```text
false, and no command
```

```sh long
false
```

* In a list:

  ```sh
  grep -q 'of a test' version.txt &&
    grep -q kept \\
      data.txt
  cat <<END > document.txt
  (one, two
  END
  for name in document.txt; do
    test -s $name
  done
  ```
"""


class Commands(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name) / "repository"
        (self.root / "docs").mkdir(parents=True)
        (self.root / "scripts").mkdir()
        (self.root / "scripts/check-docs").write_text(CHECK_DOCS.read_text(encoding="utf-8"))
        (self.root / "data.txt").write_text("kept\n")
        self.program = Path(folder.name) / "program"
        self.program.write_text("#!/bin/sh\necho of a test\n")
        self.program.chmod(0o755)
        self.git("init", "--quiet")

    def git(self, *arguments):
        identity = ["-c", "user.name=test", "-c", "user.email=test@localhost"]
        subprocess.run(["git", *identity, *arguments], cwd=self.root, check=True)

    def check(self, page, *arguments):
        """Commits the page and checks it: exit code and what was printed."""
        (self.root / "README.md").write_text(page)
        self.git("add", ".")
        self.git("commit", "--quiet", "--allow-empty", "-m", "A page")
        command = ["/usr/bin/python3", "-B", self.root / "scripts/check-docs", "--heightlight", self.program]
        done = subprocess.run([*command, *arguments], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout + done.stderr

    def test_commands_are_run_in_a_clone(self):
        self.assertEqual(self.check(PAGE), (0, "README.md: 2 blocks\n"))
        self.assertFalse((self.root / "version.txt").exists())

    def test_long_blocks_are_run_where_they_are_asked_for(self):
        self.assertEqual(self.check(PAGE, "--long"), (1, "\nREADME.md:13: failed: false\n"))

    def test_what_failed_is_named(self):
        code, printed = self.check("# A page\n\n```sh\necho before\ngrep absent data.txt && true\necho after\n```\n")
        self.assertEqual((code, printed), (1, "before\nREADME.md:5: failed: grep absent data.txt && true\n"))
        self.assertEqual(self.check("```sh\nfalse | true\n```\n")[0], 1)
        self.assertIn("README.md:2: failed: for", self.check("```sh\nfor i in 1\ndo absent_command\ndone\n```\n")[1])
        self.assertIn("README.md:3: failed: (", self.check("```sh\ntrue\n( echo\n```\n")[1])

    def test_pages_are_checked_in_order(self):
        (self.root / "docs/b.md").write_text("```sh\ntrue\n```\n")
        (self.root / "docs/a.md").write_text("no commands\n")
        self.assertEqual(self.check(PAGE), (0, "README.md: 2 blocks\ndocs/a.md: 0 blocks\ndocs/b.md: 1 blocks\n"))
        self.assertEqual(self.check(PAGE, "docs/b.md"), (0, "docs/b.md: 1 blocks\n"))
        self.assertEqual(self.check(PAGE, "docs/c.md")[0], 2)


if __name__ == "__main__":
    unittest.main()
