"""The overlap graph of parts and its cut into work units (docs/massive.md).

An edge joins two parts whose boxes are in reach of each other. The graph is halved, with few edges
between the halves, until the parts of each are few enough; the edges that were cut form a graph of
their own. Abut has METIS halve it; here pairs of nodes are swapped as long as that cuts fewer edges
[Kernighan, Lin 1970].
"""
from drawing import Drawing, View
from geometry import Random, add, boxes_overlap, corners

CLEARANCE, MOST = 0.12, 10  # reach between boxes; parts of a unit
COLORS = ["blue", "orange", "green", "violet"]


def parts():
    random = Random(4)
    boxes = []
    for row in range(5):
        for column in range(8):
            if random() < 0.16:
                continue
            center = (0.62 * column + random(-0.2, 0.2), 0.66 * row + random(-0.2, 0.2))
            half = (random(0.2, 0.5), random(0.1, 0.22))
            half = half if random() < 0.6 else half[::-1]
            boxes.append((add(center, (-half[0], -half[1])), add(center, half)))
    return boxes


def in_reach(a, b):
    grown = tuple(tuple(x + sign * CLEARANCE for x in corner) for corner, sign in zip(a, (-1, 1)))
    return boxes_overlap(grown, b)


def halve(nodes, edges, boxes):
    """Two halves of the nodes with few edges between them."""
    nodes = sorted(nodes, key=lambda k: (boxes[k][0][0] + boxes[k][1][0], k))
    sides = [set(nodes[:len(nodes) // 2]), set(nodes[len(nodes) // 2:])]

    def cut():
        return sum((a in sides[0]) != (b in sides[0]) for a, b in edges)

    def swap(a, b):
        sides[0].symmetric_difference_update((a, b))
        sides[1].symmetric_difference_update((a, b))

    while True:
        now, best = cut(), None
        for a in sorted(sides[0]):
            for b in sorted(sides[1]):
                swap(a, b)
                if cut() < now:
                    now, best = cut(), (a, b)
                swap(a, b)
        if best is None:
            return sides
        swap(*best)


def units_of(nodes, edges, boxes):
    if len(nodes) <= MOST:
        return [sorted(nodes)]
    inside = [(a, b) for a, b in edges if a in nodes and b in nodes]
    return [unit for side in halve(nodes, inside, boxes) for unit in units_of(side, inside, boxes)]


def draw():
    d = Drawing(342, "The overlap graph of some parts, cut into work units")
    boxes = parts()
    nodes = range(len(boxes))
    edges = [(a, b) for a in nodes for b in nodes if a < b and in_reach(boxes[a], boxes[b])]
    units = units_of(set(nodes), edges, boxes)
    unit_of = {k: i for i, unit in enumerate(units) for k in unit}
    cut = [e for e in edges if unit_of[e[0]] != unit_of[e[1]]]
    d.text(148, 20, "Boxes of parts", anchor="middle", size="head")
    d.text(452, 20, "Overlap graph, cut", anchor="middle", size="head")
    view = View((38, 216), 52)
    for box in boxes:
        d.polygon(view.all(corners(box)), "muted", tint="ink")
    view = View((338, 216), 52)
    at = [view(((low[0] + high[0]) / 2, (low[1] + high[1]) / 2)) for low, high in boxes]
    for e in edges:
        crosses = e in cut
        d.line(at[e[0]], at[e[1]], "ink" if crosses else COLORS[unit_of[e[0]]], dash=crosses)
    for k in nodes:
        d.dot(at[k], COLORS[unit_of[k]], 5)
    for i, unit in enumerate(units):
        pairs = sum(unit_of[a] == i and unit_of[b] == i for a, b in edges)
        x = 22 + 116 * i
        d.dot((x, 278), COLORS[i], 5)
        d.text(x + 10, 283, f"{pairs} pairs", size="small")
    d.line((486, 278), (510, 278), dash=True)
    d.text(517, 283, f"{len(cut)} pairs", size="small")
    d.text(300, 312, "Each colour is a work unit whose meshes fit into the memory. The edges that",
           anchor="middle", color="muted", size="small")
    d.text(300, 332, "were cut (dashed) form a graph of their own, which is treated alike.",
           anchor="middle", color="muted", size="small")
    return d
