"""The three stages of a contact query: boxes, leaves, pairs (docs/collide.md).

Two curves stand for surfaces, four segments for a leaf's triangles. Boxes and signs are those of the
curves, with a margin that is drawn much too large. The last stage is that of
src/geometry/triangle_triangle_intersect.cpp: intervals on the line in which two planes meet.
"""
from drawing import Drawing, View
from geometry import bounds, boxes_overlap, corners, cross, lerp, sub

A = [(-4.0, 0.5), (-3.55, 0.32), (-3.1, 0.2), (-2.6, 0.18), (-2.1, 0.22), (-1.5, 0.34), (-0.9, 0.36),
     (-0.3, 0.28), (0.3, 0.3), (0.8, 0.1), (1.2, -0.2), (1.5, -0.4), (1.7, -0.6)]
# The eighth point is set below: b crosses a, and touches it with a vertex.
B = [(-3.6, 2.1), (-3.1, 1.6), (-2.7, 1.3), (-2.35, 1.05), (-2.05, 0.85), (-1.75, -0.1), (-1.1, -0.2),
     None, (-0.3, -0.7), (0.1, -1.0), (0.6, -1.2), (1.0, -1.4), (1.3, -1.7)]
B[7] = lerp(A[6], A[7], 0.5)
MARGIN = 0.03


def segments(curve):
    return list(zip(curve, curve[1:]))


def leaves(curve):
    return [segments(curve)[i:i + 4] for i in range(0, len(curve) - 1, 4)]


def box_of(leaf):
    return bounds([p for s in leaf for p in s])


def grown(box, by):
    (x0, y0), (x1, y1) = box
    return (x0 - by, y0 - by), (x1 + by, y1 + by)


def sides(s, t):
    """On which sides of s the ends of t lie: 1, -1, or 0 where the margin leaves it open."""
    def sign(p):
        height = cross(sub(s[1], s[0]), sub(p, s[0]))
        return 0 if abs(height) < MARGIN else 1 if height > 0 else -1
    return [sign(p) for p in t]


def decide(s, t):
    """What the second stage says about two segments."""
    if not boxes_overlap(grown(bounds(s), MARGIN), bounds(t)):
        return "apart"
    signs = sides(s, t), sides(t, s)
    if any(a == b != 0 for a, b in signs):
        return "apart"
    return "cross" if all(a * b < 0 for a, b in signs) else "open"


def draw_boxes(d):
    d.text(150, 20, "1. Boxes", anchor="middle", size="head")
    view = View((170, 110), 34)
    boxes = [[box_of(leaf) for leaf in leaves(curve)] for curve in (A, B)]
    near = [(i, k) for i, a in enumerate(boxes[0]) for k, b in enumerate(boxes[1])
            if boxes_overlap(a, b)]
    assert len(near) == 1
    for side, color in ((0, "blue"), (1, "orange")):
        for i, box in enumerate(boxes[side]):
            is_near = i == near[0][side]
            d.polygon(view.all(corners(box)), color, width="line" if is_near else "thin",
                      tint=color if is_near else None, dash=not is_near)
        d.polyline(view.all((A, B)[side]), color, width="line")
    d.text(*view((1.8, -0.35)), "a", "blue", bold=True)
    d.text(*view((-3.75, 1.75)), "b", "orange", anchor="end", bold=True)
    d.lines(150, 204, ["Of nine pairs of boxes,", "one is left."], anchor="middle", color="muted",
            size="small")
    return near[0]


def draw_leaves(d, near):
    d.text(440, 20, "2. Leaves", anchor="middle", size="head")
    a, b = leaves(A)[near[0]], leaves(B)[near[1]]
    view = View((462, 112), 66)
    for leaf, color in ((a, "blue"), (b, "orange")):
        d.polyline(view.all([leaf[0][0]] + [s[1] for s in leaf]), color)
        for p in [leaf[0][0]] + [s[1] for s in leaf]:
            d.dot(view(p), color, 2.5)
    x0, y0, cell = 492, 62, 24
    counts = {"apart": 0, "cross": 0, "open": 0}
    for i, s in enumerate(a):
        for k, t in enumerate(b):
            answer = decide(s, t)
            counts[answer] += 1
            x, y = x0 + cell * i, y0 + cell * k
            d.rect(x, y, cell, cell, "faint", width="thin")
            if answer == "cross":
                d.rect(x + 4, y + 4, cell - 8, cell - 8, None, fill="green")
            elif answer == "open":
                d.circle((x + cell / 2, y + cell / 2), 7, "violet", width="bold")
    d.text(x0 + 2 * cell, y0 - 8, "a", "blue", anchor="middle", bold=True)
    d.text(x0 - 8, y0 + 2 * cell + 5, "b", "orange", anchor="end", bold=True)
    legend = ((None, f"{counts['apart']} pairs are certainly apart,"),
              ("cross", f"{counts['cross']} certainly crosses,"),
              ("open", f"{counts['open']} are left open."))
    for row, (sign, text) in enumerate(legend):
        y = 194 + 20 * row
        if sign == "cross":
            d.rect(345, y - 12, 13, 13, None, fill="green")
        elif sign == "open":
            d.circle((351, y - 5), 6, "violet", width="bold")
        d.text(366, y, text, "muted", size="small")


def sub3(p, q):
    return tuple(a - b for a, b in zip(p, q))


def cross3(p, q):
    return (p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0])


def dot3(p, q):
    return sum(a * b for a, b in zip(p, q))


def on_line(triangle, other):
    """Where a triangle's edges pass through the other's plane."""
    n = cross3(sub3(other[1], other[0]), sub3(other[2], other[0]))
    heights = [dot3(n, sub3(p, other[0])) for p in triangle]
    found = []
    for i in range(3):
        k = (i + 1) % 3
        if heights[i] * heights[k] < 0:
            t = heights[i] / (heights[i] - heights[k])
            found.append(tuple(p + t * (q - p) for p, q in zip(triangle[i], triangle[k])))
    return found


def draw_pair(d):
    d.text(300, 264, "3. Pairs", anchor="middle", size="head")
    a = [(-1.6, -0.9, 0), (1.3, -0.5, 0), (-0.2, 1.5, 0)]
    b = [(0.15, 0.25, 1.2), (-0.9, 0.35, -0.8), (1.5, 0.1, -0.9)]

    def flat(p):
        return (158 + 68 * (p[0] + 0.35 * p[1]), 372 - 68 * (0.42 * p[1] + 0.85 * p[2]))

    d.polygon([flat(p) for p in a], "blue", tint="blue")
    d.polygon([flat(p) for p in b], "orange", tint="orange")
    spans = [sorted(on_line(a, b)), on_line(b, a)]
    way = sub3(spans[0][1], spans[0][0])
    at = [sorted(dot3(way, sub3(p, spans[0][0])) / dot3(way, way) for p in span) for span in spans]

    def place(t):
        return flat(tuple(p + t * q for p, q in zip(spans[0][0], way)))

    d.line(place(-0.4), place(1.5), "muted", width="thin", dash=True)
    low, high = max(s[0] for s in at), min(s[1] for s in at)
    d.line(place(low), place(high), "green", width="bold")
    for span, color in zip(at, ("blue", "orange")):
        for t in span:
            d.dot(place(t), color, 4)
    wide = at[1][1] - at[1][0]
    for row, (name, shift) in enumerate((("apart", at[0][1] - at[1][0] + 0.25),
                                         ("touch", at[0][1] - at[1][0]), ("cross", 0))):
        y, left = 304 + 42 * row, 352

        def x(t):
            return left + 82 * (t - min(at[0][0], at[1][0]))

        d.line((left - 8, y), (548, y), "faint", width="thin")
        begin = at[1][0] + shift
        d.line((x(at[0][0]), y - 5), (x(at[0][1]), y - 5), "blue", width="bold")
        d.line((x(begin), y + 5), (x(begin + wide), y + 5), "orange", width="bold")
        d.text(left - 18, y + 5, name, anchor="end")
    d.lines(300, 438, ["Both triangles cut the line in which their planes meet, if they reach it.",
                       "Exact signs compare the ends of the two intervals there."],
            anchor="middle", color="muted", size="small")


def draw():
    d = Drawing(470, "Boxes, leaves and pairs: each stage passes on what it cannot decide")
    draw_leaves(d, draw_boxes(d))
    draw_pair(d)
    return d
