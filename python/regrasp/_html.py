"""What notebooks show."""

from __future__ import annotations

import base64
import html


def picture(png: bytes, title: str) -> str:
    """A PNG as a picture in the page."""
    data = base64.b64encode(png).decode("ascii")
    return f'<img src="data:image/png;base64,{data}" alt="{html.escape(title)}" style="max-width:100%">'


def drawing(svg: str, title: str) -> str:
    """An SVG as a picture in the page, by itself: names in one do not meet those in another."""
    data = base64.b64encode(svg.encode()).decode("ascii")
    return (f'<img src="data:image/svg+xml;base64,{data}" alt="{html.escape(title)}" '
            'style="max-width:100%;background:white">')


def text(lines: str) -> str:
    """Text with its columns."""
    return f'<pre style="white-space:pre-wrap">{html.escape(lines)}</pre>'


def table(head: list[str], rows: list[list[str]]) -> str:
    """A table of texts."""
    def row(cells, tag):
        return "<tr>" + "".join(f"<{tag}>{html.escape(cell)}</{tag}>" for cell in cells) + "</tr>"
    return ("<table><thead>" + row(head, "th") + "</thead><tbody>"
            + "".join(row(cells, "td") for cells in rows) + "</tbody></table>")
