"""Takes what stands beside docs/ into the site, so that pages read alike on a forge and in the site.

Pages link to ../plots/NAME, as they must where the repository is read as plain Markdown. The site has the same files
under plots/.
"""

import re
from pathlib import Path

from mkdocs.structure.files import File

ROOT = Path(__file__).resolve().parent.parent
PATTERNS = ("plots/*.png", "plots/*.md", "plots/data/*.md", "plots/data/*.csv")


def on_files(files, config):
    for pattern in PATTERNS:
        for path in sorted(ROOT.glob(pattern)):
            name = path.relative_to(ROOT).as_posix()
            files.append(File(name, str(ROOT), config["site_dir"], config["use_directory_urls"]))
    return files


def on_page_markdown(markdown, page, config, files):
    markdown = re.sub(r"^```(\w+) \w+$", r"```\1", markdown, flags=re.MULTILINE)  # `sh long`: the site wants one word
    if page.file.src_uri.startswith("plots/"):
        return re.sub(r"\]\(\.\./docs/", "](../", markdown)
    return markdown.replace("](../plots/", "](plots/")
