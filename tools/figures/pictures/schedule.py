"""The heap of pairs by the lower bound of their time to collision (docs/world.md).

The bound is that of src/world/schedule/time_to_collision_schedule.cpp, for discs that do not turn:
with the distance d, the relative speed v and what the accelerations may add, a.
"""
import heapq
import math

from drawing import Drawing, View
from geometry import add, boxes_overlap, mul, sub, unit

# Name, centre, radius, velocity, bound on the acceleration.
BODIES = [("A", (0.7, 3.5), 0.34, (0.9, -0.35), 0.1), ("B", (2.7, 3.1), 0.42, (-0.6, -0.5), 0.1),
          ("C", (0.8, 1.55), 0.40, (0.8, 0.5), 0.1), ("D", (2.4, 1.1), 0.36, (-0.3, 0.85), 0.1),
          ("E", (4.1, 2.0), 0.30, (-1.1, 0.15), 0.1), ("F", (4.25, 3.9), 0.3, (0.2, 0.1), 0.1)]
HORIZON = 1.2


def swept_box(body):
    _, center, radius, velocity, bound = body
    end = add(center, mul(HORIZON, velocity))
    reach = radius + 0.5 * bound * HORIZON**2
    return tuple(tuple(pick(p, q) + sign * reach for p, q in zip(center, end))
                 for pick, sign in ((min, -1), (max, 1)))


def time_to_collision(a, b):
    d = math.dist(a[1], b[1]) - a[2] - b[2]
    v, bound = math.hypot(*sub(a[3], b[3])), a[4] + b[4]
    return 2 * d / (v + math.sqrt(v * v + 2 * bound * d))


def draw():
    d = Drawing(338, "Pairs of bodies in a heap, by the lower bound of their time to collision")
    d.text(136, 20, "Bodies and swept boxes", anchor="middle", size="head")
    d.text(452, 20, "Heap of pairs", anchor="middle", size="head")
    view = View((10, 292), 56)
    for body in BODIES:
        name, center, radius, velocity, _ = body
        (x0, y0), (x1, y1) = swept_box(body)
        (x, y), (u, w) = view((x0, y1)), view((x1, y0))
        d.rect(x, y, u - x, w - y, "faint", width="thin")
    for name, center, radius, velocity, _ in BODIES:
        d.circle(view(center), radius * view.scale, "blue", tint="blue")
        start = add(center, mul(radius, unit(velocity)))
        if math.hypot(*velocity) > 0.4:
            d.arrow(view(start), view(add(start, mul(0.5, velocity))), "blue", head=8)
        x, y = view(center)
        d.text(x, y + 6, name, "blue", anchor="middle", bold=True)
    heap = []
    for i, a in enumerate(BODIES):
        for b in BODIES[i + 1:]:
            if boxes_overlap(swept_box(a), swept_box(b)):
                heapq.heappush(heap, (time_to_collision(a, b), a[0] + b[0]))
    row = [(436, 76), (372, 160), (500, 160), (338, 244), (412, 244), (486, 244), (560, 244)]
    for k in range(1, len(heap)):
        x, y = row[(k - 1) // 2]
        d.line((x, y + 24), (row[k][0], row[k][1] - 22), "muted")
    for k, (time, pair) in enumerate(heap):
        x, y = row[k]
        color = "orange" if k == 0 else "violet"
        d.rect(x - 34, y - 24, 68, 48, color, radius=6, tint=color)
        d.text(x, y - 4, f"{pair[0]}, {pair[1]}", color, anchor="middle", bold=True)
        d.text(x, y + 15, f"{time:.2f} s", anchor="middle", size="small")
    d.arrow((580, 76), (474, 76), "orange")
    d.text(528, 64, "taken next", "orange", anchor="middle", size="small")
    d.lines(300, 308, ["Only pairs whose swept boxes overlap are in the heap. The first pair",
                       "is tested when its time has come, and goes back with a new bound."],
            anchor="middle", color="muted", size="small")
    return d
