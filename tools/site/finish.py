"""What is changed in a site that mkdocs has built."""
import json
import re

import check

CODE = re.compile(r"(?<!</span>)(?<!<pre>)<code>([^<]*)</code>")


def remove_hosts(out):
    """The theme can draw diagrams with a script from another host. No page has such diagrams."""
    for script in out.rglob("*.js"):
        text = script.read_text(errors="surrogateescape")
        without = re.sub(check.SCRIPT_OF_A_HOST, "about:blank", text)
        if without != text:
            script.write_text(without, errors="surrogateescape")
    for maps in out.rglob("*.map"):
        maps.unlink()


def trim_search(out, left_out):
    """Takes pages whose names begin so out of the search: sources and rows of numbers."""
    path = out / "search" / "search_index.json"
    index = json.loads(path.read_text())
    index["docs"] = [each for each in index["docs"] if not each["location"].startswith(tuple(left_out))]
    path.write_text(json.dumps(index, separators=(",", ":")))


def break_code(out):
    """Lines may break in a path after a slash or an underscore, and never in an option."""

    def broken(found):
        words = found[1].split(" ")
        for i, word in enumerate(words):
            if word.startswith("-"):
                words[i] = f'<span class="whole">{word}</span>'
            elif re.search(r"[/_]", word) and len(word) > 20:
                words[i] = re.sub(r"([/_])(?=\w)", r"\1<wbr>", word)
        return f"<code>{' '.join(words)}</code>"

    for path in out.rglob("*.html"):
        text = path.read_text()
        path.write_text(CODE.sub(broken, text))
