"""HTML representations for notebooks."""

from __future__ import annotations

import base64
import html


def picture(png: bytes, title: str) -> str:
    """Return a PNG as an HTML image."""
    data = base64.b64encode(png).decode("ascii")
    return f'<img src="data:image/png;base64,{data}" alt="{html.escape(title)}" style="max-width:100%">'


def drawing(svg: str, title: str) -> str:
    """Return an SVG as a separate HTML image, so that identifiers of two images do not collide."""
    data = base64.b64encode(svg.encode()).decode("ascii")
    return (f'<img src="data:image/svg+xml;base64,{data}" alt="{html.escape(title)}" '
            'style="max-width:100%;background:white">')


def frame(page: str, title: str) -> str:
    """Return a page as an HTML element that is separate from the notebook, scripts and styles included."""
    return (f'<iframe srcdoc="{html.escape(page)}" title="{html.escape(title)}" width="100%" height="830" '
            'style="border:0" allowfullscreen></iframe>')


def text(lines: str) -> str:
    """Return preformatted text."""
    return f'<pre style="white-space:pre-wrap">{html.escape(lines)}</pre>'


def folded(title: str, lines: str) -> str:
    """Return preformatted text that opens with a click on its title."""
    return f"<details><summary>{html.escape(title)}</summary>{text(lines)}</details>"


def table(head: list[str], rows: list[list[str]]) -> str:
    """Return an HTML table."""
    def row(cells, tag):
        return "<tr>" + "".join(f"<{tag}>{html.escape(cell)}</{tag}>" for cell in cells) + "</tr>"
    return ("<table><thead>" + row(head, "th") + "</thead><tbody>"
            + "".join(row(cells, "td") for cells in rows) + "</tbody></table>")
