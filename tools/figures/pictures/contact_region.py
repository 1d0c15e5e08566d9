"""How the points of a contact are found: two faces, cut with each other along the normal, and the
four corners that stay (docs/contacts.md)."""
import math

from drawing import Drawing, View
from geometry import add, cross, dot, edges, lerp, sub, turned, unit

FACE_A = [(-1.5, -1.1), (1.5, -1.1), (1.5, 1.1), (-1.5, 1.1)]
FACE_B = [add((0.62, 0.3), turned(p, 0.5)) for p in ((-1.2, -1), (1.2, -1), (1.2, 1), (-1.2, 1))]
SLOPE = unit((-1.0, -0.15))  # along it, b reaches deeper into a


def cut(polygon, other):
    """The common part of two convex polygons [Sutherland, Hodgman 1974]."""
    for p, q in edges(other):
        def beyond(r, p=p, q=q):
            return cross(sub(q, p), sub(r, p)) < 0
        kept = []
        for r, s in edges(polygon):
            if not beyond(r):
                kept.append(r)
            if beyond(r) != beyond(s):
                h, k = cross(sub(q, p), sub(r, p)), cross(sub(q, p), sub(s, p))
                kept.append(lerp(r, s, h / (h - k)))
        polygon = kept
    return polygon


def four(corners):
    """The deepest corner, the one farthest from it, and the farthest on both sides of their line."""
    first = max(corners, key=lambda p: dot(p, SLOPE))
    second = max(corners, key=lambda p: math.dist(p, first))
    along = sub(second, first)
    return [first, second, max(corners, key=lambda p: cross(along, sub(p, first))),
            min(corners, key=lambda p: cross(along, sub(p, first)))]


def draw_section(d):
    """Two boxes in section, that overlap a little."""
    d.text(140, 22, "1. A normal, and two faces", anchor="middle", size="head")
    view = View((140, 150), 62)
    a = [(-1.5, -1.2), (1.5, -1.2), (1.5, 0), (-1.5, 0)]
    b = [add((0.45, 0.62), turned(p, 0.13)) for p in ((-1.05, -0.62), (1.05, -0.62), (1.05, 0.62), (-1.05, 0.62))]
    d.polygon(view.all(a), "blue", tint="blue")
    d.polygon(view.all(b), "orange", tint="orange")
    d.line(view(a[3]), view(a[2]), "blue", width="bold")
    d.line(view(b[0]), view(b[1]), "orange", width="bold")
    d.text(*view((0, -0.8)), "a", "blue", anchor="middle", bold=True)
    d.text(*view((0.42, 0.6)), "b", "orange", anchor="middle", bold=True)
    d.arrow(view((-1.15, 0)), view((-1.15, 0.85)), "green")
    d.text(*view((-1.28, 0.55)), "n", "green", anchor="end", bold=True)
    d.lines(140, 258, ["The face of each body that is", "most opposed to the other."],
            anchor="middle", color="muted", size="small")


def draw_region(d):
    """The faces as seen along the normal."""
    d.text(446, 22, "2. Seen along the normal", anchor="middle", size="head")
    view = View((432, 136), 62)
    d.polygon(view.all(FACE_A), "blue", tint="blue")
    d.polygon(view.all(FACE_B), "orange", tint="orange")
    region = cut(FACE_B, FACE_A)
    assert len(region) > 4
    d.polygon(view.all(region), "ink", tint="ink")
    chosen = four(region)
    for p in region:
        d.dot(view(p), "green" if p in chosen else "muted", 5 if p in chosen else 3)
    d.line(*view.all(chosen[:2]), "green", width="thin", dash=True)
    for k, p in enumerate(chosen):
        (x, y), out = view(p), unit(sub(p, (0.45, 0.15)))
        d.text(x + 16 * out[0], y - 14 * out[1] + 5, str(k + 1), "green", anchor="middle", bold=True)
    d.text(*view((-1.42, -0.98)), "a", "blue", bold=True)
    d.text(*view((1.42, 1.42)), "b", "orange", bold=True)
    d.lines(446, 258, ["Of all corners, four stay: the", "deepest (1), the farthest from it (2),",
                       "the farthest beside both (3, 4)."], anchor="middle", color="muted", size="small")


def draw():
    d = Drawing(306, "Contact points: two faces, their common region along the normal, four corners")
    draw_section(d)
    draw_region(d)
    return d
