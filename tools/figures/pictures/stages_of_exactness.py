"""Which stage decides elementary tests (docs/elementary-tests.md has the numbers)."""
from drawing import Drawing

STAGES = [("Filter", ["directions,", "cubic's signs"], "eight pairs", "blue"),
          ("Crossings", ["one root,", "proven"], "eight pairs", "green"),
          ("Intervals", ["any cubic"], "one pair", "violet"),
          ("Exact", ["integers"], "one pair", "orange")]
# 3,324 queries of the benchmark of Wang et al. 2021.
QUERIES = [("filter", 2791, "blue"), ("crossings and intervals", 257, "green"),
           ("exact", 276, "orange")]
# 403,553 pairs of cloth-ball that the filter leaves.
CLOTH = [("crossings", 397662, "green"), ("later stages", 403553 - 397662, "orange")]


def bar(d, y, title, shares):
    left, wide = 10, 580
    total = sum(share[1] for share in shares)
    d.text(left, y - 12, title, size="small")
    x = left
    label = left
    for name, count, color in shares:
        w = wide * count / total
        d.rect(x, y, w, 26, color, tint=color)
        text = f"{name} {100 * count / total:.1f} %"
        d.rect(label, y + 38, 12, 12, color, tint=color)
        d.text(label + 18, y + 49, text, size="small")
        label += 140 if name == "filter" else 265
        x += w


def draw():
    assert sum(share[1] for share in QUERIES) == 3324
    d = Drawing(352, "The stages of an elementary test, and what each decides")
    width, gap = 124, 28
    for k, (head, texts, together, color) in enumerate(STAGES):
        x = 2 + k * (width + gap)
        d.box(x, 2, width, 86, head, texts, color)
        d.text(x + width / 2, 108, together, "muted", anchor="middle", size="small")
        if k < 3:
            d.arrow((x + width + 3, 45), (x + width + gap - 3, 45))
    d.text(300, 140, "Each stage decides what it can prove and passes on the rest.",
           anchor="middle")
    bar(d, 188, "3,324 benchmark queries (Wang et al. 2021):", QUERIES)
    bar(d, 290, "403,553 pairs of cloth-ball that the filter leaves:", CLOTH)
    return d
