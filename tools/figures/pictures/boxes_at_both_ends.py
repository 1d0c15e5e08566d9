"""Two moving edges whose swept boxes overlap, and whose boxes at both ends prove that they never
meet (docs/representative-triangles.md, src/volume/moving_box.h)."""
from drawing import Drawing, View
from geometry import bounds, boxes_overlap, corners

# Each edge at the start and at the end of the step.
A = ([(0.1, 0.35), (1.5, 0.0)], [(2.2, 1.75), (3.5, 1.3)])
B = ([(0.3, 0.8), (1.35, 1.35)], [(2.0, 2.35), (3.25, 3.0)])


def swept(feature):
    return bounds(feature[0] + feature[1])


def apart_on(axis, a, b):
    """Whether a lies below b along an axis at the start and at the end."""
    return all(bounds(a[end])[1][axis] < bounds(b[end])[0][axis] for end in (0, 1))


def draw():
    assert boxes_overlap(swept(A), swept(B)) and apart_on(1, A, B)
    d = Drawing(330, "Swept boxes overlap; boxes at both ends of the step are apart")
    d.text(118, 20, "One swept box each", anchor="middle", size="head")
    d.text(420, 20, "Boxes at both ends", anchor="middle", size="head")
    for column, x in enumerate((14, 252)):
        view = View((x, 238), 60)
        for feature, color, name in ((A, "blue", "a"), (B, "orange", "b")):
            if column == 0:
                d.polygon(view.all(corners(swept(feature))), color, tint=color)
            for end in (0, 1):
                if column == 1:
                    d.polygon(view.all(corners(bounds(feature[end]))), color, tint=color)
                d.line(view(feature[end][0]), view(feature[end][1]), color, width="bold")
            for k in (0, 1):
                d.line(view(feature[0][k]), view(feature[1][k]), color, width="thin", dash=True)
        d.text(*view((-0.1, 1.3) if column else (0.3, 2.68)), "b", "orange", bold=True)
        d.text(*view((3.6, 1.35) if column else (3.25, 0.2)), "a", "blue", bold=True)
    left = View((0, 238), 60)
    d.arrow((494, 240), (494, 46), "muted", width="thin")
    for end, x in ((0, 508), (1, 564)):
        for feature, color in ((A, "blue"), (B, "orange")):
            low, high = bounds(feature[end])
            d.rect(x, left(high)[1], 18, left(low)[1] - left(high)[1], color, tint=color)
        d.text(x + 9, 258, f"t = {end}", anchor="middle", size="small")
    d.text(118, 286, "They overlap:", anchor="middle")
    d.text(118, 306, "the pair must be tested.", anchor="middle")
    d.text(420, 286, "a lies below b at the start and at the end:", anchor="middle")
    d.text(420, 306, "moving in straight lines, they never meet.", anchor="middle")
    return d
