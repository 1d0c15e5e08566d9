"""Checks a built site: every link leads to a page and an anchor of it, nothing is fetched from another
host, and no Markdown is left over in the text."""
import html.parser
import re
import urllib.parse

SILENT = {"pre", "code", "script", "style", "svg", "nav"}
HOST = re.compile(r"https?://")
# A script, a style or a font by its full address, as text of a script.
SCRIPT_OF_A_HOST = re.compile(r"""https?://[^\s"'`)]+\.(?:m?js|css|woff2?)(?=["'`])""")
FETCHED = {("script", "src"), ("img", "src"), ("link", "href"), ("iframe", "src"), ("source", "src"), ("video", "src")}
LEFT_OVER = re.compile(r"^(?:\s*[-*] \S|\s*\|.*\|\s*$|#+ )|```|\]\([\w./#-]+\)", re.M)


class Page(html.parser.HTMLParser):
    """The anchors, links and left-over Markdown of a page."""

    def __init__(self, text):
        super().__init__()
        self.anchors, self.links, self.fetched, self.left_over = set(), [], [], []
        self.silent = 0  # how many elements around the text are not prose
        self.feed(text)

    def handle_endtag(self, tag):
        self.silent -= tag in SILENT

    def handle_data(self, text):
        found = not self.silent and LEFT_OVER.search(text)
        if found:
            self.left_over.append(found[0].strip())

    def handle_starttag(self, tag, attributes):
        self.silent += tag in SILENT
        for name, value in attributes:
            if name in ("id", "name") and value:
                self.anchors.add(value)
            if (tag, name) in FETCHED and value:
                self.fetched.append(value)
            if name in ("href", "src") and value:
                self.links.append(value)


def faults(out):
    """What is wrong, one line each."""
    pages = {path: Page(path.read_text()) for path in out.rglob("*.html")}
    found = []
    for path, page in pages.items():
        name = path.relative_to(out)
        found += [f"{name}: fetches {value}" for value in page.fetched if HOST.match(value) or value.startswith("//")]
        found += [f"{name}: Markdown that was not understood: {each}" for each in page.left_over]
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
        for fetched in re.findall(r"(?:url\(|@import |fetch\(|importScripts\()[\"']?(?:https?:)?//[^\"')]+", text):
            found.append(f"{path.relative_to(out)}: fetches {fetched}")
        for fetched in SCRIPT_OF_A_HOST.findall(text):
            found.append(f"{path.relative_to(out)}: names {fetched}")
        if "googleapis.com" in text:
            found.append(f"{path.relative_to(out)}: names another host")
    return sorted(set(found))
