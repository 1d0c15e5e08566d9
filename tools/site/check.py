"""Checks a built site: every link leads to a page and an anchor of it, and nothing is fetched from
another host."""
import html.parser
import re
import urllib.parse

HOST = re.compile(r"https?://")
FETCHED = {("script", "src"), ("img", "src"), ("link", "href"), ("iframe", "src"), ("source", "src"), ("video", "src")}


class Page(html.parser.HTMLParser):
    """The anchors and links of a page."""

    def __init__(self, text):
        super().__init__()
        self.anchors, self.links, self.fetched = set(), [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name in ("id", "name") and value:
                self.anchors.add(value)
            if (tag, name) in FETCHED and value:
                self.fetched.append(value)
            if name in ("href", "src") and value:
                self.links.append(value)


def remove_hosts(out):
    """The theme can draw diagrams with a script from another host. No page has such diagrams."""
    for script in out.rglob("*.js"):
        text = script.read_text(errors="surrogateescape")
        if "https://unpkg.com" in text:
            script.write_text(re.sub(r"https://unpkg\.com/[\w./@-]+", "about:blank", text), errors="surrogateescape")
    for maps in out.rglob("*.map"):
        maps.unlink()


def faults(out):
    """What is wrong, one line each."""
    pages = {path: Page(path.read_text()) for path in out.rglob("*.html")}
    found = []
    for path, page in pages.items():
        name = path.relative_to(out)
        found += [f"{name}: fetches {value}" for value in page.fetched if HOST.match(value) or value.startswith("//")]
        for link in page.links:
            parts = urllib.parse.urlsplit(link)
            if parts.scheme or parts.netloc or name.name == "404.html":
                continue
            to = (path.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else path
            if to.is_dir():
                to = to / "index.html"
            anchor = urllib.parse.unquote(parts.fragment)
            if not to.is_file():
                found.append(f"{name}: links to {link}, which is not there")
            elif anchor and to in pages and anchor not in pages[to].anchors and not anchor.startswith("__"):
                found.append(f"{name}: links to {link}, an anchor that is not there")
    for path in [*out.rglob("*.css"), *out.rglob("*.js")]:
        text = path.read_text(errors="replace")
        for fetched in re.findall(r"(?:url\(|@import |fetch\(|importScripts\(|unpkg\.com|\bcdn\.)[\"']?(?:https?:)?//[^\"')]+", text):
            found.append(f"{path.relative_to(out)}: fetches {fetched}")
        if "unpkg.com" in text or "googleapis.com" in text:
            found.append(f"{path.relative_to(out)}: names another host")
    return sorted(set(found))
