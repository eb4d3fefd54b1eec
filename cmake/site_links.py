"""Of mkdocs.yml: links that lead out of the documents have no page; they become the file's path."""

import re


def on_page_markdown(markdown, **_):
    """Called by mkdocs for each page."""
    return re.sub(r"\[([^\]]*)\]\((?:\.\./)+([^)#]*)(?:#[^)]*)?\)", r"\1 (`\2`)", markdown)
