"""Takes what stands beside docs/ into the site, so that pages read alike on a forge and in the site.

Pages link to ../plots/NAME and the like, as they must where the repository is read as plain Markdown. The site has the
same files under plots/ and so on.
"""

import re
from pathlib import Path

from mkdocs.structure.files import File

ROOT = Path(__file__).resolve().parent.parent
BESIDE = re.compile(r"\]\(\.\./([^)#]+)")


def on_files(files, config):
    """Adds every file beside docs/ that a page links to."""
    linked = set()
    for page in Path(config["docs_dir"]).glob("*.md"):
        linked.update(BESIDE.findall(page.read_text(encoding="utf-8")))
    for name in sorted(linked):
        if (ROOT / name).is_file():
            files.append(File(name, str(ROOT), config["site_dir"], config["use_directory_urls"]))
    return files


def on_page_markdown(markdown, page, config, files):
    """Makes links lead to those files, and the marks of fences one word, as the site wants them."""
    markdown = re.sub(r"^```(\w+) \w+$", r"```\1", markdown, flags=re.MULTILINE)
    return BESIDE.sub(r"](\1", markdown) if "/" not in page.file.src_uri else markdown
