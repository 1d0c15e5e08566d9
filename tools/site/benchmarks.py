"""Tables and plots of bench/results: the rows that abut-bench prints, as text or JSON.

A row has a case, our time, a peer's time and ratio = theirs / ours: above 1 we are faster.
"""
import collections
import html
import json
import math
import re
import statistics

ROW = re.compile(r"^(?P<case>\S.*?) +(?P<ours>[\d.]+(?:e[+-]\d+)?) +(?P<theirs>[\d.]+(?:e[+-]\d+)?) +"
                 r"(?P<ratio>\d+\.\d+)  (?P<unit>\S+) +(?P<threads>\d+)  (?P<peer>\S.*)$")
SUITE = re.compile(r"abut-bench ([\w-]+)")
LIBRARIES = ("FCL", "Bullet", "CGAL", "Embree", "Assimp")
SUBJECTS = {
    "clash": "clashes of many parts", "rigid": "two models", "impact": "times of impact", "shapes": "shape queries",
    "convex": "convex bodies", "pieces": "solids of convex pieces", "world": "many moving boxes",
    "manifolds": "contacts of many bodies", "model-contacts": "contacts of two models",
    "ccd": "elementary tests and deforming surfaces", "massive": "stores", "import": "reading files",
    "walk": "walks"}
MOST_ROWS = 36  # of a plot on the overview

Row = collections.namedtuple("Row", "suite case ours theirs ratio unit threads peer")


def rows_of(name, text):
    """The rows of a file of results, in its order. The suite of a block is the one that the block or
    the text before it names, else empty."""
    suite, found, inside = "", [], False
    if name.endswith(".json"):
        report = json.loads(text)
        return [Row(report["suite"], row["case"], row["ours"], row["theirs"], row["ratio"], row["unit"], row["threads"],
                    row["peer"]) for row in report["rows"] if row["ratio"]]
    for line in text.splitlines():
        if line.startswith("```"):
            inside = not inside
            suite = suite if inside else ""
        named = SUITE.search(line)
        if named:
            suite = named[1]
        row = ROW.match(line)
        if row:
            found.append(Row(suite, row["case"].strip(), float(row["ours"]), float(row["theirs"]), float(row["ratio"]),
                             row["unit"], int(row["threads"]), row["peer"].strip()))
    return found


def library(peer):
    """The library of a peer; empty for another way of our own."""
    return next((name for name in LIBRARIES if peer.startswith(name)), "")


def number(value):
    return f"{value:.3g}" if value < 1000 else f"{value:,.0f}"


def table(rows):
    text = ["| case | ours | theirs | ratio | unit | threads | peer |", "| --- | ---: | ---: | ---: | --- | ---: | --- |"]
    text += [f"| {row.case} | {number(row.ours)} | {number(row.theirs)} | {row.ratio:.2f} | {row.unit} | {row.threads} "
             f"| {row.peer} |" for row in rows]
    return "\n".join(text) + "\n"


def plot(rows, title):
    """A bar for each row on a logarithmic axis, from a ratio of 1 to the right if we are faster."""
    ratios = [row.ratio for row in rows]
    low = math.floor(min(0.0, math.log10(max(min(ratios), 1e-3))))
    high = math.ceil(max(1.0, math.log10(max(ratios))))
    left, width, top = 16, 264, 26

    def x(ratio):
        place = (math.log10(max(ratio, 1e-3)) - low) / (high - low)
        return left + width * min(1.0, max(0.0, place))

    body, y, last = [], top, None
    for row in rows:
        if row.case != last:
            y += 20
            body.append(f'<text x="{left}" y="{y}" class="case">{html.escape(row.case)}</text>')
            last = row.case
        begin, end = sorted((x(1), x(row.ratio)))
        side = "faster" if row.ratio >= 1 else "slower"
        words = f"{row.case}: ours {number(row.ours)}, {row.peer} {number(row.theirs)} {row.unit}"
        body.append(f'<rect x="{begin:.1f}" y="{y + 5}" width="{max(end - begin, 1):.1f}" height="11" class="{side}">'
                    f"<title>{html.escape(words)}</title></rect>")
        body.append(f'<text x="{max(end, x(1)) + 5:.1f}" y="{y + 14.5}" class="value">{row.ratio:.2f} '
                    f"{html.escape(row.peer[:26])}</text>")
        y += 17
    height = y + 12
    grid = []
    for power in range(low, high + 1):
        place, kind = x(10.0 ** power), "one" if power == 0 else "line"
        grid.append(f'<path d="M{place:.1f},{top} V{height - 4}" class="{kind}"/>'
                    f'<text x="{place:.1f}" y="{top - 7}" class="axis">{10.0 ** power:g}</text>')
    return (f'<figure class="plot"><svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 480 {height}" role="img" '
            f'aria-label="{html.escape(title)}"><text x="{left + width + 30}" y="{top - 7}" class="value">theirs / ours</text>'
            + "".join(grid + body) + "</svg></figure>\n")


def folded(summary, text):
    return f'<details markdown="1">\n<summary>{html.escape(summary)}</summary>\n\n{text}\n</details>\n'


def with_plots(name, text):
    """A page of results; below its rows a plot and a table of them."""
    blocks = re.split(r"(^```.*?^```\n)", text, flags=re.M | re.S)
    for i, block in enumerate(blocks):
        rows = rows_of(name, block)
        if block.startswith("```") and rows:
            blocks[i] += "\n" + folded(f"Plot of {len(rows)} rows", plot(rows, f"Ratios of {name}"))
    return "".join(blocks)


def compared(rows, suite):
    """The rows of a suite beside a library, the last of each case and peer."""
    return list({(row.case, row.peer): row for row in rows if row.suite == suite and library(row.peer)}.values())


def representative(suite, rows):
    """The newest file with at least half as many rows of a suite as the fullest file."""
    counts = {name: len(compared(rows[name], suite)) for name in sorted(rows)}
    full = max(counts.values(), default=0)
    return max((name for name in counts if full and counts[name] * 2 >= full), default=None)


def page_of(name):
    """The page of a file: JSON is shown as a source."""
    return name if name.endswith(".md") else name + ".md"


def overview(files):
    """The page of all measurements. `files` maps names to texts; newer names come later."""
    rows = {name: rows_of(name, text) for name, text in files.items()}
    text = ["# Measurements\n",
            "Made from the files of this folder. `ratio` is theirs / ours: above 1 Abut is faster, below 1 the peer "
            "is. Times of different files were measured on different machines, many beside other load: compare "
            "ratios within a row. [Benchmarks](../README.md) says what each suite does.\n"]
    for suite, subject in SUBJECTS.items():
        name = representative(suite, rows)
        if not name:
            continue
        drawn = compared(rows[name], suite)
        most = f" The first {MOST_ROWS} of {len(drawn)} rows are drawn." if len(drawn) > MOST_ROWS else ""
        text += [f"## {suite}: {subject}\n",
                 f"From [{name.rsplit('.', 1)[0]}]({page_of(name)}), the newest full run beside other libraries.{most}\n",
                 plot(drawn[:MOST_ROWS], f"Ratios of the suite {suite}"), folded("As a table", table(drawn))]
    text += ["## All files\n", "Each with the median ratio to each library, and the number of rows in brackets. Files "
             "without a ratio compare Abut with itself or have tables of their own.\n", "| file | median ratios |",
             "| --- | --- |"]
    for name in sorted(files):
        heading = re.search(r"^# (.*)$", files[name], re.M)
        ratios = {peer: [row.ratio for row in rows[name] if library(row.peer) == peer] for peer in LIBRARIES}
        medians = ", ".join(f"{peer} {statistics.median(each):.1f} ({len(each)})" for peer, each in ratios.items() if each)
        text.append(f"| [{heading[1] if heading else name}]({page_of(name)}) | {medians} |")
    return "\n".join(text) + "\n"
