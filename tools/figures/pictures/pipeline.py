"""From model files to clashes and reports (docs/architecture.md, docs/collide.md)."""
from drawing import Drawing

W, H, GAP = 172, 84, 40
X = [2, 2 + W + GAP, 2 + 2 * (W + GAP)]
Y = [2, 150, 298]


def draw():
    d = Drawing(402, "From model files to clashes")
    rows = [
        [("Model files", ["IFC, glTF, STL, …"], "ink"),
         ("Parts, meshes", ["each mesh once,", "parts refer to it"], "ink"),
         ("Memory or store", ["a store holds more", "than the memory"], "ink")],
        [("Broad phase", ["pairs of parts whose", "boxes are in reach"], "blue"),
         ("Hierarchies", ["two trees, eight", "boxes a pass"], "blue"),
         ("Leaves", ["16 pairs of triangles", "in single precision"], "blue")],
        [("Exact tests", ["double precision,", "then integers"], "orange"),
         ("Clashes", ["kind, distance,", "witness points"], "green"),
         ("Reports", ["HTML, JSON, CSV"], "green")],
    ]
    for y, row in zip(Y, rows):
        for x, (head, texts, color) in zip(X, row):
            d.box(x, y, W, H, head, texts, color)
        for x in X[:2]:
            d.arrow((x + W + 5, y + H / 2), (x + W + GAP - 5, y + H / 2))
    for k in (0, 1):
        middle = (Y[k] + H + Y[k + 1]) / 2
        start, end = X[2] + W / 2, X[0] + W / 2
        d.polyline([(start, Y[k] + H + 5), (start, middle), (end, middle)])
        d.arrow((end, middle), (end, Y[k + 1] - 4))
    return d
