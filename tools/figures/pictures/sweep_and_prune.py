"""Sweep and prune on one axis: the sorted ends of boxes in two steps (docs/world.md).

The sort is the insertion sort of src/world/broad_phase/sweep_and_prune.cpp. At equal coordinates
lower ends come first.
"""
from drawing import Drawing

# Name, interval in the last step, interval in this step, height, colour.
BOXES = [("A", (0.4, 3.0), (0.7, 3.3), 0.2, "blue"),
         ("B", (2.4, 5.1), (1.9, 4.6), 1.25, "orange"),
         ("C", (4.8, 7.0), (5.0, 7.2), 0.2, "green"),
         ("D", (7.3, 10.0), (6.6, 9.3), 1.25, "violet")]


def ends(step):
    """The ends of all boxes in the order of the axis: (coordinate, is upper, box)."""
    return sorted((box[step][upper], upper, k) for k, box in enumerate(BOXES) for upper in (0, 1))


def swaps():
    """The pairs of ends that change places in the insertion sort, as (upper, box)."""
    order = [(upper, k) for _, upper, k in ends(1)]
    found = []
    for i in range(1, len(order)):
        j = i
        while j > 0:
            (upper, k), (before_upper, before) = order[j], order[j - 1]
            if (BOXES[before][2][before_upper], before_upper) <= (BOXES[k][2][upper], upper):
                break
            found.append((order[j - 1], order[j]))
            order[j - 1], order[j] = order[j], order[j - 1]
            j -= 1
    assert order == [(upper, k) for _, upper, k in ends(2)]
    return found


LEFT, UNIT, CELL = 34, 54, 66


def draw_step(d, step, axis, up):
    """The boxes on one side of the axis (above it if `up`), the list of ends on the other.

    Returns where each end's cell meets the other step's list.
    """
    places = {}
    for label, *intervals, height, color in BOXES:
        low, high = intervals[step - 1]
        x, w = LEFT + UNIT * low, UNIT * (high - low)
        y = axis - 42 - 40 * height if up else axis + 8 + 40 * height
        d.rect(x, y, w, 34, color, tint=color)
        d.text(x + 0.3 * w, y + 23, label, color, anchor="middle", bold=True)
        for at in (low, high):
            edge = y + 34 if up else y
            d.line((LEFT + UNIT * at, edge), (LEFT + UNIT * at, axis), color, width="thin",
                   dash=True)
    d.arrow((LEFT - 10, axis), (LEFT + UNIT * 10.35, axis), "muted")
    for i, (at, upper, k) in enumerate(ends(step)):
        x, color = LEFT + 6 + CELL * i, BOXES[k][4]
        y = axis + 30 if up else axis - 30 - 28
        near = (y - 2) if up else y + 30
        d.line((LEFT + UNIT * at, axis), (x + CELL / 2 - 4, near), "faint", width="thin")
        d.rect(x, y, CELL - 8, 28, color, tint=color)
        d.text(x + CELL / 2 - 4, y + 20, BOXES[k][0] + " ]" if upper else "[ " + BOXES[k][0], color,
               anchor="middle")
        places[upper, k] = (x + CELL / 2 - 4, y + 31 if up else y - 3)
    return places


def draw():
    d = Drawing(474, "The sorted ends of boxes on one axis, in two steps")
    d.text(LEFT - 10, 20, "Last step", size="head")
    before = draw_step(d, 1, 122, True)
    after = draw_step(d, 2, 314, False)
    d.text(LEFT - 10, 414, "This step", size="head")
    swapped = swaps()
    for first, second in swapped:
        for end in (first, second):
            d.line(before[end], after[end])
        x = (before[first][0] + before[second][0]) / 2
        begins = (first[0], second[0]) == (1, 0)  # a lower end comes to stand before an upper one
        a, b = sorted((BOXES[first[1]][0], BOXES[second[1]][0]))
        d.text(x + (-34 if not begins else 34), 224, f"{a}{b} {'begins' if begins else 'ends'}",
               anchor="start" if begins else "end", bold=True)
    d.text(300, 444, "[ A and A ] are the lower and the upper end of box A.", anchor="middle",
           color="muted", size="small")
    d.text(300, 464, "Only pairs whose ends change places in the sorted list are tested.",
           anchor="middle", color="muted", size="small")
    return d
