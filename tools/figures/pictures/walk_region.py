"""Which parts a walk has in memory (docs/walk.md).

Parts are read in the order of their key, as src/walk/predicted_path.h defines it: the least, over
points of the predicted path, of the distance from the point plus an eighth of the way to it. Those
of older plans stay until their memory is needed.
"""
import math

from drawing import Drawing, View
from geometry import Random, add, corners, length, mul, sub

POSITION, VELOCITY, LOOK_AHEAD = (2.6, 1.7), (0.95, 0.22), 3.0
POINTS, SHARE = 16, 0.125
READ, IN_MEMORY, REACH = 30, 42, 0.62  # parts of this plan; parts in all; a query's `within`


def parts():
    random = Random(9)
    boxes = []
    for row in range(8):
        for column in range(20):
            if random() < 0.12:
                continue
            center = (0.42 * column + random(-0.08, 0.08), 0.48 * row + random(-0.08, 0.08))
            half = (random(0.06, 0.15), random(0.06, 0.15))
            boxes.append((add(center, (-half[0], -half[1])), add(center, half)))
    return boxes


def gap(box, p):
    return math.hypot(*(max(box[0][i] - p[i], p[i] - box[1][i], 0) for i in (0, 1)))


def key(box, position):
    """What orders the parts of a plan made at a position."""
    way = mul(LOOK_AHEAD, VELOCITY)
    steps = [i / (POINTS - 1) for i in range(POINTS)]
    return min(SHARE * s * length(way) + gap(box, add(position, mul(s, way))) for s in steps)


def level_set(position, level):
    """The outline of all points of at most one key: circles that shrink along the path."""
    way = mul(LOOK_AHEAD, VELOCITY)
    last = level - SHARE * length(way)
    heading = math.atan2(way[1], way[0])
    spread = math.acos((level - last) / length(way))  # where the tangents touch both circles
    points = []
    for center, radius, start, end in ((position, level, spread, 2 * math.pi - spread),
                                       (add(position, way), last, -spread, spread)):
        for i in range(49):
            angle = heading + start + (end - start) * i / 48
            points.append(add(center, (radius * math.cos(angle), radius * math.sin(angle))))
    return points


def draw():
    d = Drawing(372, "The parts near a walk's position and path that are in memory")
    boxes = parts()
    view = View((30, 246), 66)
    earlier = sub(POSITION, mul(1.6, VELOCITY))
    order = sorted(range(len(boxes)), key=lambda k: key(boxes[k], POSITION))
    reached = set(order[:READ])
    before = [k for k in sorted(range(len(boxes)), key=lambda k: key(boxes[k], earlier))[:READ]
              if k not in reached]
    kept = set(before[:IN_MEMORY - READ])
    level = key(boxes[order[READ - 1]], POSITION)
    d.polygon(view.all(level_set(POSITION, level)), "blue", dash=True)
    for k, box in enumerate(boxes):
        if k in reached:
            d.polygon(view.all(corners(box)), "blue", tint="blue")
        elif k in kept:
            d.polygon(view.all(corners(box)), "orange", tint="orange")
        else:
            d.polygon(view.all(corners(box)), "faint")
    d.circle(view(POSITION), REACH * view.scale, "green", tint="green")
    d.arrow(view(POSITION), view(add(POSITION, mul(LOOK_AHEAD, VELOCITY))), "ink", width="bold",
            head=13)
    d.dot(view(POSITION), "ink", 6)
    rows = [("green", "near: what a query within a distance asks for"),
            ("blue", "ahead: read already, in the order of the distance from the path"),
            ("orange", "cached: read by earlier plans, evicted first"),
            ("faint", "not in memory")]
    for i, (color, text) in enumerate(rows):
        y = 274 + 24 * i
        d.rect(20, y, 15, 15, color, tint=None if color == "faint" else color)
        d.text(44, y + 13, text, size="small")
    return d
