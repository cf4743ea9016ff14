"""Every block of Python on the pages runs, from the top of its page to the end."""

import contextlib
import io
import os
import re
import unittest

from support import SOURCE, InFolder

PAGES = sorted((SOURCE / "docs/python").glob("*.md"))


def blocks(page):
    """(language, code) of each fenced block."""
    return re.findall(r"^```(\w*)\n(.*?)^```", page.read_text(), re.MULTILINE | re.DOTALL)


class Pages(InFolder):
    def test_every_block_runs(self):
        self.assertGreaterEqual(len(PAGES), 2)
        os.chdir(self.folder)
        self.addCleanup(os.chdir, SOURCE)
        for page in PAGES:
            found = blocks(page)
            self.assertTrue(found, page)
            names = {"__name__": "page"}
            for number, (language, code) in enumerate(found):
                with self.subTest(f"{page.name}, block {number + 1}"):
                    self.assertEqual(language, "python")
                    text = io.StringIO()
                    with contextlib.redirect_stdout(text):
                        exec(compile(code.replace('__name__ == "__main__"', "True"), str(page), "exec"), names)

    def test_the_readme_shows_what_runs(self):
        readme = (SOURCE / "README.md").read_text()
        found = re.findall(r"^```python\n(.*?)^```", readme, re.MULTILINE | re.DOTALL)
        self.assertTrue(found)
        os.chdir(self.folder)
        self.addCleanup(os.chdir, SOURCE)
        for code in found:
            with contextlib.redirect_stdout(io.StringIO()):
                exec(compile(code, "README.md", "exec"), {"__name__": "page"})


if __name__ == "__main__":
    unittest.main()
