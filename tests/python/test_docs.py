"""Every block of Python on the pages runs, from the top of its page to the end; the site has every page."""

import contextlib
import io
import os
import unittest

from support import SOURCE, InFolder, blocks

PAGES = sorted((SOURCE / "docs/python").glob("*.md"))


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
                if language == "sh":  # test_install.py runs it
                    self.assertEqual(page.name, "README.md")
                    continue
                with self.subTest(f"{page.name}, block {number + 1}"):
                    self.assertEqual(language, "python")
                    text = io.StringIO()
                    with contextlib.redirect_stdout(text):
                        exec(compile(code.replace('__name__ == "__main__"', "True"), str(page), "exec"), names)

    def test_the_readme_shows_what_runs(self):
        found = [code for language, code in blocks(SOURCE / "README.md") if language == "python"]
        self.assertTrue(found)
        os.chdir(self.folder)
        self.addCleanup(os.chdir, SOURCE)
        for code in found:
            with contextlib.redirect_stdout(io.StringIO()):
                exec(compile(code, "README.md", "exec"), {"__name__": "page"})

    def test_the_site_has_every_page(self):
        listed = (SOURCE / "docs/site/mkdocs.yml").read_text().split("\nnav:\n")[1]
        pages = [path for path in (SOURCE / "docs").rglob("*.md") if SOURCE / "docs/site" not in path.parents]
        self.assertGreater(len(pages), 30)
        for page in pages:
            self.assertRegex(listed, rf"(- | ){page.relative_to(SOURCE)}\n")


if __name__ == "__main__":
    unittest.main()
