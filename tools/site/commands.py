"""The reference of the command: one page for each verb, from what `abut VERB --help` prints."""
import html
import os
import re
import subprocess

ENTRY = re.compile(r"^ {2,4}(\S.*?)(?: {2,}(\S.*))?$")


def help_of(program, *verb):
    plain = {**os.environ, "NO_COLOR": "1", "COLUMNS": "80", "TERM": "dumb"}
    return subprocess.run([program, *verb, "--help"], env=plain, capture_output=True, text=True, check=True).stdout


def sections(text):
    """The titles of a help text with their lines; the first title is empty."""
    found = [("", [])]
    for line in text.splitlines():
        title = re.match(r"^([A-Z][^:]*):$", line)
        if title:
            found.append((title[1], []))
        else:
            found[-1][1].append(line)
    return found


def entries(lines):
    """Terms with their descriptions: a line with two to four spaces begins one, deeper lines go on."""
    found = []
    for line in lines:
        begun = ENTRY.match(line)
        if begun:
            found.append([begun[1], begun[2] or ""])
        elif line.strip() and found and line.startswith("  "):
            found[-1][1] = (found[-1][1] + " " + line.strip()).strip()
    return found


def verbs(program):
    """The verbs in the order of the help, each with its group and sentence."""
    groups = []
    for title, lines in sections(help_of(program)):
        rows = entries(lines)
        if rows and all(re.fullmatch(r"[a-z-]+", term) and not term.startswith("-") for term, _ in rows):
            groups.append((title, rows))
    return groups


def definitions(rows):
    body = "".join(f"<dt><code>{html.escape(term, quote=False)}</code></dt>"
                   f"<dd>{html.escape(text, quote=False)}</dd>" for term, text in rows)
    return f'<dl class="options">{body}</dl>\n'


def page(program, verb):
    text = [f"# abut {verb}\n"]
    for title, lines in sections(help_of(program, verb)):
        if not title:
            for part in "\n".join(lines).strip().split("\n\n"):
                usage = part.startswith("Usage: ")
                one = " ".join(part.split())
                text.append(f"```console\n$ {one[7:]}\n```\n" if usage else f"{html.escape(one, quote=False)}.\n")
            continue
        text.append(f"## {title}\n")
        rows = entries(lines)
        if title == "Examples":
            text += [f"{explained[:1].upper() + explained[1:]}:\n```console\n$ {line}\n```\n" for line, explained in rows]
        else:
            text.append(definitions(rows))
        text += [f"{line.strip()}\n" for line in lines if re.match(r"\S", line)]
    text.append(f"What `--json` prints: [the keys](../json/{verb}.md).\n")
    return "\n".join(text)


def write_commands(program, out):
    """Writes the pages to out/reference/command and returns their paths, the index first."""
    folder = out / "reference" / "command"
    folder.mkdir(parents=True)
    index = ["# The command\n", "What `abut VERB --help` says. [JSON](../json/README.md) has the keys of `--json`, "
             "[scripts](../../docs/scripts.md) the exit statuses.\n"]
    pages = ["reference/command/README.md"]
    for title, rows in verbs(program):
        index += [f"## {title}\n", "| verb | what it does |", "| --- | --- |"]
        for verb, sentence in rows:
            (folder / f"{verb}.md").write_text(page(program, verb))
            index.append(f"| [{verb}]({verb}.md) | {html.escape(sentence, quote=False)} |")
            pages.append(f"reference/command/{verb}.md")
        index.append("")
    (folder / "README.md").write_text("\n".join(index))
    return pages
