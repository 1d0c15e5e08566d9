"""The C++ reference: one page for each public header, from the XML that Doxygen writes."""
import html
import pathlib
import re
import subprocess
import sys
import xml.etree.ElementTree as xml

from pygments import highlight
from pygments.formatters import HtmlFormatter
from pygments.lexers import CppLexer

SETTINGS = """
INPUT = include/abut
RECURSIVE = YES
OUTPUT_DIRECTORY = {work}
GENERATE_HTML = NO
GENERATE_LATEX = NO
GENERATE_XML = YES
XML_PROGRAMLISTING = NO
INCLUDE_GRAPH = NO
INCLUDED_BY_GRAPH = NO
INPUT_FILTER = {tools}/docstrings
STRIP_FROM_PATH = include
STRIP_FROM_INC_PATH = include
EXTRACT_ALL = YES
QUIET = YES
WARN_IF_UNDOCUMENTED = NO
WARN_AS_ERROR = FAIL_ON_WARNINGS
"""
INTRODUCTION = re.compile(r"((?:^///.*\n)+)namespace abut", re.M)


def run_doxygen(root, work):
    """Runs Doxygen on the public headers and returns the folder of its XML."""
    settings = SETTINGS.format(work=work, tools=pathlib.Path(__file__).parent)
    if subprocess.run(["doxygen", "-"], input=settings, text=True, cwd=root, check=False).returncode:
        sys.exit("tools/build_site: doxygen has warnings")
    return work / "xml"


class Reference:
    """The documented entities of all headers, and the pages made of them."""

    def __init__(self, root, folder):
        self.root = root
        self.compounds = {}  # by id: classes and structures
        self.members = {}  # by header: enumerations, functions and variables of the namespace
        self.places = {}  # by id: (page, anchor)
        self.names = {}  # of classes and enumerations: (page, anchor)
        for path in sorted(folder.glob("*.xml")):
            compound = xml.parse(path).getroot().find("compounddef")
            if compound is None:
                continue
            if compound.get("kind") in ("class", "struct"):
                self.compounds[compound.get("id")] = compound
            elif compound.findtext("compoundname") == "abut":
                for member in compound.iter("memberdef"):
                    self.members.setdefault(header_of(member), []).append(member)
        self.find_places()

    def find_places(self):
        for each in self.compounds.values():
            page, name = page_of(header_of(each)), short(each.findtext("compoundname"))
            self.places[each.get("id")] = self.names[name] = (page, name)
            for member in each.iter("memberdef"):
                self.places[member.get("id")] = (page, name)
        for header, members in self.members.items():
            for member in members:
                name = member.findtext("name")
                self.places[member.get("id")] = (page_of(header), name)
                if member.get("kind") in ("enum", "typedef"):
                    self.names[name] = (page_of(header), name)
                for value in member.iter("enumvalue"):
                    self.places[value.get("id")] = (page_of(header), name)

    def headers(self):
        return sorted(set(self.members) | {header_of(each) for each in self.compounds.values()})

    def introduction(self, header):
        """What the header says about itself, above its namespace."""
        text = (self.root / "include" / header).read_text()
        in_c = re.search(r"\n/\*\*\n((?: \* .+\n)+)", text)
        if in_c:
            return " ".join(line[3:] for line in in_c[1].splitlines())
        found = INTRODUCTION.search(text)
        return " ".join(line[3:].strip() for line in found[1].splitlines()) if found else ""

    def page(self, header):
        """The page of a header, in Markdown, in the order of the header."""
        text = [f"# {header.split('/')[-1]}\n", code(f"#include <{header}>")]
        text.append(f"<p>{link_pages(prose(self.introduction(header)))}</p>\n")
        entities = [(line_of(each), each) for each in self.compounds.values() if header_of(each) == header]
        entities += [(line_of(each), each) for each in self.members.get(header, [])]
        entities.sort(key=lambda entity: entity[0])
        used = set()
        for group in grouped([entity for _, entity in entities]):
            text.append(self.entity(group, used))
        return "\n".join(text)

    def entity(self, group, used):
        first = group[0]
        if first.tag == "compounddef":
            name = short(first.findtext("compoundname"))
            heading = f"{first.get('kind')} {name}"
        else:
            name, heading = first.findtext("name"), first.findtext("name")
            if first.get("kind") == "enum":
                heading = f"enum {heading}"
        anchor = name if name not in used else f"{name}-{len(used)}"
        used.add(name)
        body = self.compound(first) if first.tag == "compounddef" else self.member(group)
        return f"## {heading} {{#{anchor}}}\n\n{body}\n"

    def compound(self, compound):
        members = [each for each in compound.iter("memberdef") if each.get("prot") == "public"
                   and each.get("kind") != "friend"]
        members.sort(key=line_of)
        text = [self.description(compound)]
        values = [each for each in members if each.get("kind") == "variable"]
        if values:
            rows = "".join(f"<dt>{self.code(declaration(each), inline=True)}</dt>" + self.answer(each)
                           for each in values)
            text.append(f'<dl class="members">{rows}</dl>')
        for group in grouped([each for each in members if each.get("kind") != "variable"]):
            text.append(f'<div class="member">{self.member(group)}</div>')
        return "\n".join(text)

    def answer(self, member):
        text = self.description(member)
        return f"<dd>{text}</dd>" if text else ""

    def member(self, group):
        lines = "\n".join(declaration(each) for each in group)
        text = self.code(lines) + self.description(group[0])
        values = "".join(f"<dt><code>{each.findtext('name')}</code></dt><dd>{self.description(each)}</dd>"
                         for each in group[0].iter("enumvalue") if self.description(each))
        return text + (f'<dl class="members">{values}</dl>' if values else "")

    def description(self, element):
        return "".join(self.paragraphs(element.find(tag)) for tag in ("briefdescription", "detaileddescription")
                       if element.find(tag) is not None)

    def paragraphs(self, element):
        """Paragraphs as HTML. Headed ones become a list of heading and text."""
        text = ""
        for para in element.findall("para"):
            headed = para.findall("simplesect")
            plain = self.inline(para)
            if plain.strip():
                text += f"<p>{plain.strip()}</p>"
            if headed:
                rows = "".join(f"<dt>{html.escape(each.findtext('title'))}</dt>"
                               f"<dd>{self.paragraphs(each)}</dd>" for each in headed)
                text += f'<dl class="headed">{rows}</dl>'
        return text.replace("</dl><dl class=\"headed\">", "")

    def inline(self, element):
        text = html.escape(element.text or "", quote=False)
        for child in element:
            if child.tag == "computeroutput":
                text += f"<code>{self.inline(child)}</code>"
            elif child.tag == "ref":
                text += self.link(child.get("refid"), self.inline(child))
            elif child.tag == "verbatim":
                text += f"</p><pre><code>{html.escape(child.text.strip(chr(10)))}</code></pre><p>"
            elif child.tag != "simplesect":
                text += self.inline(child)
            text += html.escape(child.tail or "", quote=False)
        return link_pages(text)

    def link(self, target, text):
        if target not in self.places:
            return text
        page, anchor = self.places[target]
        return f'<a href="{page}.html#{anchor}">{text}</a>'

    def code(self, text, inline=False):
        """A declaration in colours, whose types are links."""
        body = highlight(text, CppLexer(), HtmlFormatter(nowrap=True)).strip("\n")

        def linked(found):
            name = html.unescape(found[2])
            if name not in self.names:
                return found[0]
            page, anchor = self.names[name]
            return f'<span class="{found[1]}"><a href="{page}.html#{anchor}">{found[2]}</a></span>'

        body = re.sub(r'<span class="(n|nc|nf|kt)">(\w+)</span>', linked, body)
        if inline:
            return f'<code class="highlight">{body}</code>'
        return f'<div class="highlight"><pre><code>{body}</code></pre></div>'


def header_of(element):
    return element.find("location").get("file")


def line_of(element):
    return int(element.find("location").get("line"))


def page_of(header):
    return pathlib.PurePath(header).name


def short(name):
    return name.removeprefix("abut::")


def grouped(members):
    """Overloads without a comment of their own belong to the one above them."""
    groups = []
    for member in members:
        last = groups[-1][-1] if groups else None
        bare = not "".join(text.strip() for tag in ("briefdescription", "detaileddescription")
                           for text in member.find(tag).itertext())
        if (last is not None and bare and member.get("kind") == last.get("kind") == "function"
                and member.findtext("name") == last.findtext("name")):
            groups[-1].append(member)
        else:
            groups.append([member])
    return groups


def tidy(text):
    """Code as this project writes it: `vector<Model>& a`."""
    text = re.sub(r"\s+", " ", text)
    text = text.replace("< ", "<").replace(" >", ">")
    return re.sub(r" ?([&*]+) ?(?=[\w&*)]|$)", r"\1 ", text).strip()


def declaration(member):
    kind = member.get("kind")
    kept = "".join(member.find("type").itertext()) if member.find("type") is not None else ""
    name = member.findtext("name")
    if kind == "enum":
        values = ", ".join(each.findtext("name") for each in member.iter("enumvalue"))
        head = f"enum class {name}" + (f" : {kept}" if kept else "")
        one = f"{head} {{ {values} }};"
        return one if len(one) <= 100 else head + " {\n    " + values.replace(", ", ",\n    ") + "\n};"
    if kind == "typedef":
        return tidy(f"using {name} = {kept};")
    if kind == "variable":
        given = member.find("initializer")
        value = tidy("".join(given.itertext())) if given is not None else ""
        if value and not value.startswith(("=", "{")):
            value = "= " + value
        return tidy(f"{kept} {name}") + (" " + value if value.startswith("=") else value) + ";"
    return function_declaration(member, kept, name)


def function_declaration(member, kept, name):
    head = tidy(f"{kept} {name}").strip()
    if member.get("static") == "yes" and not head.startswith("static"):
        head = "static " + head
    if member.get("explicit") == "yes" and not head.startswith("explicit"):
        head = "explicit " + head
    parameters = []
    for each in member.findall("param"):
        text = "".join(each.find("type").itertext())
        text += " " + each.findtext("declname", "")
        text += "".join(each.findtext("array", ""))
        given = each.find("defval")
        parameters.append(tidy(text).strip() + (f" = {tidy(''.join(given.itertext()))}" if given is not None else ""))
    rest = member.findtext("argsstring", "").rsplit(")", 1)[-1].replace("=", " = ").replace("  ", " ")
    template = member.find("templateparamlist")
    before = ""
    if template is not None:
        names = [tidy("".join(each.find("type").itertext()) + " " + each.findtext("declname", "")).strip()
                 for each in template.findall("param")]
        before = f"template <{', '.join(names)}>\n"
    one = f"{head}({', '.join(parameters)}){rest};"
    if len(one) <= 90:
        return before + one
    return before + f"{head}(\n    " + ",\n    ".join(parameters) + f"){rest};"


def prose(text):
    return re.sub(r"`([^`]+)`", r"<code>\1</code>", html.escape(text, quote=False))


def link_pages(text):
    """Names of pages as links."""
    return re.sub(r"(?<![\w/>\"])docs/([\w/-]+)\.md", r'<a href="../../docs/\1.html">docs/\1.md</a>', text)


def code(text):
    return f"```cpp\n{text}\n```\n"


def write_reference(root, work, out):
    """Writes the pages to out/reference/cpp and returns their paths, the index first."""
    reference = Reference(root, run_doxygen(root, work))
    folder = out / "reference" / "cpp"
    folder.mkdir(parents=True)
    rows = ["# C++ reference\n", "One page for each public header. `#include <abut/abut.h>` includes all of them.\n",
            "| header | what it has |", "| --- | --- |"]
    pages = []
    for header in reference.headers():
        name = page_of(header)
        (folder / f"{name}.md").write_text(reference.page(header))
        first = reference.introduction(header).split(". ")[0].rstrip(".")
        names = sorted({anchor for page, anchor in reference.places.values() if page == name and "::" not in anchor})
        rows.append(f"| [{name}]({name}.md) | {first + '.' if first else ', '.join(f'`{each}`' for each in names)} |")
        pages.append(f"reference/cpp/{name}.md")
    (folder / "README.md").write_text("\n".join(rows) + "\n")
    return ["reference/cpp/README.md"] + pages
