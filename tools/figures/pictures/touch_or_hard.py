"""The boundary cases of a touch tolerance, in section (docs/touch-or-hard.md).

The tolerance is drawn 0.22 long. Each pair is off by 0.6 of it, or goes far beyond it.
"""
from drawing import Drawing, View

T = 0.22
OFF = 0.6 * T


def rect(x0, y0, x1, y1):
    return [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]


SLEEVE = [rect(-1.3, 0.4, 1.3, 0.85), rect(-1.3, -0.85, 1.3, -0.4)]
U = [(-1.1, -0.9), (1.1, -0.9), (1.1, 0.75), (0.65, 0.75), (0.65, -0.4), (-0.65, -0.4),
     (-0.65, 0.75), (-1.1, 0.75)]
SCENES = [
    ("flush slab", "touch", [rect(-1.3, -0.85, 1.3, -0.1)],
     [rect(-0.35, -0.1 - OFF, 0.35, 0.9)], ["sunk by less than t:", "nowhere deeper"]),
    ("bar in its sleeve", "touch", SLEEVE, [rect(-1.45, -0.4 - OFF, 1.45, 0.4 + OFF)],
     ["too thick by less than t:", "the common part is thin"]),
    ("body in a U", "touch", [U], [rect(-0.65 - OFF, -0.4 - OFF, 0.65 + OFF, 0.55)],
     ["sunk into three faces,", "also in the corners"]),
    ("copy beside itself", "duplicate", [rect(-0.9, -0.8, 0.9, 0.75)],
     [rect(-0.9 + OFF, -0.8, 0.9 + OFF, 0.75)], ["each surface within t", "of the other one"]),
    ("sheet through a beam", "hard", [rect(-0.5, -0.8, 0.5, 0.8)],
     [rect(-1.4, -0.07, 1.4, 0.07)], ["thinner than t, but deep", "in the beam"]),
    ("walls in one line", "hard", [rect(-1.4, -0.4, 0.3, 0.4)], [rect(-0.3, -0.4, 1.4, 0.4)],
     ["flush faces, but the", "common part is thick"]),
]


def draw():
    d = Drawing(470, "Boundary cases of the touch tolerance t: touch, duplicate and hard")
    for i, (name, kind, first, second, texts) in enumerate(SCENES):
        x, y = 100 + 200 * (i % 3), 106 + 236 * (i // 3)
        view = View((x, y), 60)
        d.text(x, y - 84, name, anchor="middle", size="head")
        for polygon in first:
            d.polygon(view.all(polygon), "blue", tint="blue")
        for polygon in second:
            d.polygon(view.all(polygon), "orange", tint="orange")
        d.text(x, y + 74, kind, "green" if kind == "touch" else "violet", anchor="middle",
               size="head")
        d.lines(x, y + 94, texts, anchor="middle", size="small")
    return d
