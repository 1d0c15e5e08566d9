"""Line drawings as SVG that suit light and dark pages.

A figure is 600 units wide and has a transparent background. Colours are named by role; each has a
value for light and one for dark pages. The style sheet lists literal colours in both, because not
every viewer knows CSS variables. Points are (x, y) pairs, y downwards; a View maps a world with y
upwards. The output depends on nothing but the calls: coordinates are rounded to 1/100.
"""
import math
from xml.sax.saxutils import escape

WIDTH = 600

# role: (light page, dark page)
COLORS = {
    "ink": ("#1f2328", "#e6edf3"),
    "muted": ("#57606a", "#a3adb8"),
    "faint": ("#c4ccd4", "#495059"),
    "blue": ("#1f66ad", "#79b4f2"),
    "orange": ("#b8500f", "#f2a05e"),
    "green": ("#2b7a3f", "#73c98a"),
    "violet": ("#7a47b5", "#c39bf5"),
}
TINT = 0.14  # opacity of a filled area
WIDTHS = {"thin": 1, "line": 1.6, "bold": 3}
SIZES = {"label": 16, "small": 15, "head": 17}
FONT = 'Helvetica, Arial, "Liberation Sans", sans-serif'

# Advance widths of Helvetica in 1/1000 of the font size, from the space to the tilde.
ADVANCES = [
    278, 278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333, 278, 278,
    556, 556, 556, 556, 556, 556, 556, 556, 556, 556, 278, 278, 584, 584, 584, 556,
    1015, 667, 667, 722, 722, 667, 611, 778, 722, 278, 500, 667, 556, 833, 722, 778,
    667, 778, 722, 667, 611, 722, 667, 944, 667, 667, 611, 278, 278, 278, 469, 556,
    333, 556, 556, 500, 556, 556, 278, 556, 556, 222, 222, 500, 222, 833, 556, 556,
    556, 556, 333, 500, 278, 556, 500, 722, 500, 500, 500, 334, 260, 334, 584]


def text_width(text, size):
    """Width of a text; an underscore makes the next character a subscript of 0.7 of the size."""
    total, scale = 0.0, 1.0
    for c in text:
        if c == "_":
            scale = 0.7
            continue
        total += scale * (ADVANCES[ord(c) - 32] if " " <= c <= "~" else 600)
        scale = 1.0
    return total * size / 1000


def number(x):
    text = f"{x:.2f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text


def pair(p):
    return f"{number(p[0])},{number(p[1])}"


class View:
    """Maps a world with y upwards to the drawing."""

    def __init__(self, origin, scale):
        self.origin, self.scale = origin, scale

    def __call__(self, p):
        return (self.origin[0] + self.scale * p[0], self.origin[1] - self.scale * p[1])

    def all(self, points):
        return [self(p) for p in points]


class Drawing:
    def __init__(self, height, title):
        self.height, self.title = height, title
        self.elements = []
        self.used = set()
        self.texts = []  # (left, top, right, bottom, text)
        self.points = []  # of lines and polygons

    # Shapes. `stroke` and `fill` are names of colours, `tint` that of a light fill.

    def path(self, data, stroke=None, width="line", fill=None, tint=None, dash=False):
        classes = []
        if stroke:
            classes += [f"stroke-{stroke}", width]
        if dash:
            classes.append("dash")
        if fill:
            classes.append(f"fill-{fill}")
        elif tint:
            classes.append(f"tint-{tint}")
        self.used.update(classes)
        self.elements.append(f'<path class="{" ".join(classes)}" d="{data}"/>')

    def polyline(self, points, stroke="ink", **style):
        self.points += points
        self.path("M" + " ".join(pair(p) for p in points), stroke, **style)

    def polygon(self, points, stroke="ink", **style):
        self.points += points
        self.path("M" + " ".join(pair(p) for p in points) + "Z", stroke, **style)

    def line(self, p, q, stroke="ink", **style):
        self.polyline([p, q], stroke, **style)

    def rect(self, x, y, w, h, stroke="ink", radius=0, **style):
        if radius == 0:
            self.polygon([(x, y), (x + w, y), (x + w, y + h), (x, y + h)], stroke, **style)
            return
        r, n = radius, number
        self.path(
            f"M{n(x + r)},{n(y)}h{n(w - 2 * r)}a{r},{r} 0 0 1 {r},{r}v{n(h - 2 * r)}"
            f"a{r},{r} 0 0 1 -{r},{r}h{n(2 * r - w)}a{r},{r} 0 0 1 -{r},-{r}v{n(2 * r - h)}"
            f"a{r},{r} 0 0 1 {r},-{r}Z", stroke, **style)

    def circle(self, center, radius, stroke="ink", **style):
        (x, y), r, n = center, number(radius), number
        self.path(f"M{n(x - radius)},{n(y)}a{r},{r} 0 1 0 {n(2 * radius)},0"
                  f"a{r},{r} 0 1 0 {n(-2 * radius)},0Z", stroke, **style)

    def dot(self, center, color="ink", radius=3.5):
        self.circle(center, radius, None, fill=color)

    def arrow(self, p, q, stroke="ink", width="line", dash=False, both=False, head=9):
        """A line from p to q with a head at q, and at p too if `both`."""
        length = math.dist(p, q)
        u = ((q[0] - p[0]) / length, (q[1] - p[1]) / length)

        def tip(at, sign):
            back = (at[0] - sign * head * u[0], at[1] - sign * head * u[1])
            side = (0.38 * head * u[1], -0.38 * head * u[0])
            self.polygon([at, (back[0] + side[0], back[1] + side[1]),
                          (back[0] - side[0], back[1] - side[1])], None, fill=stroke)
            return (at[0] - sign * 0.8 * head * u[0], at[1] - sign * 0.8 * head * u[1])

        end = tip(q, 1)
        begin = tip(p, -1) if both else p
        self.line(begin, end, stroke, width=width, dash=dash)

    def text(self, x, y, text, color="ink", anchor="start", size="label", bold=False):
        """A line of text on the baseline y. An underscore makes the next character a subscript."""
        points = SIZES[size]
        bold = bold or size == "head"
        wide = text_width(text, points) * (1.07 if bold else 1)
        left = x - {"start": 0, "middle": wide / 2, "end": wide}[anchor]
        self.texts.append((left, y - 0.72 * points, left + wide, y + 0.2 * points, text))
        classes = [f"fill-{color}", size] + (["strong"] if bold else [])
        if anchor != "start":
            classes.append(anchor)
        self.used.update(classes)
        parts = text.split("_")
        body = escape(parts[0])
        for part in parts[1:]:
            drop, lower = number(0.22 * points), number(0.7 * points)
            body += f'<tspan dy="{drop}" font-size="{lower}">{escape(part[0])}</tspan>'
            if part[1:]:
                body += f'<tspan dy="-{drop}">{escape(part[1:])}</tspan>'
        self.elements.append(
            f'<text class="{" ".join(classes)}" x="{number(x)}" y="{number(y)}">{body}</text>')

    def lines(self, x, y, texts, step=20, **style):
        """Several lines of text, the first at y."""
        for i, text in enumerate(texts):
            self.text(x, y + i * step, text, **style)

    def box(self, x, y, w, h, head, texts=(), color="ink"):
        """A box of a flow chart with a heading and lines of text."""
        for text in [head, *texts]:  # other fonts are up to a tenth wider
            if 1.1 * text_width(text, SIZES["label" if text == head else "small"]) > w - 8:
                raise ValueError(f"'{text}' is too wide for its box")
        self.rect(x, y, w, h, color, radius=6, tint=color)
        top = y + h / 2 - 10 * len(texts) + 6
        self.text(x + w / 2, top, head, anchor="middle", size="label", bold=True)
        self.lines(x + w / 2, top + 20, texts, anchor="middle", size="small", color="muted")

    def check(self):
        """Raises ValueError if something leaves the drawing or two texts overlap."""
        for x, y in self.points:
            if not (1 <= x <= WIDTH - 1 and 1 <= y <= self.height - 1):
                raise ValueError(f"a line leaves the drawing at {pair((x, y))}")
        for i, (left, top, right, bottom, text) in enumerate(self.texts):
            if left < 1 or top < 1 or right > WIDTH - 1 or bottom > self.height - 1:
                raise ValueError(f"'{text}' leaves the drawing")
            for other in self.texts[:i]:
                if left < other[2] and other[0] < right and top < other[3] and other[1] < bottom:
                    raise ValueError(f"'{text}' overlaps '{other[4]}'")

    def style(self):
        fixed = {"dash": "stroke-dasharray:5 4", "middle": "text-anchor:middle",
                 "end": "text-anchor:end", "strong": "font-weight:600"}
        fixed |= {name: f"stroke-width:{width}" for name, width in WIDTHS.items()}
        fixed |= {name: f"font-size:{size}px" for name, size in SIZES.items()}

        def colored(page):
            rules = []
            for name, values in COLORS.items():
                for kind, rule in (("stroke", f"stroke:{values[page]}"),
                                   ("fill", f"fill:{values[page]}"),
                                   ("tint", f"fill:{values[page]};fill-opacity:{TINT}")):
                    if f"{kind}-{name}" in self.used:
                        rules.append(f".{kind}-{name}{{{rule}}}")
            return rules

        rules = [f"text{{font-family:{FONT}}}",
                 "path{fill:none;stroke-linejoin:round;stroke-linecap:round}"]
        rules += [f".{name}{{{rule}}}" for name, rule in fixed.items() if name in self.used]
        rules += colored(0)
        rules.append("@media (prefers-color-scheme: dark){" + "".join(colored(1)) + "}")
        return "\n".join(rules)

    def svg(self):
        self.check()
        head = (f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{self.height}" '
                f'viewBox="0 0 {WIDTH} {self.height}" role="img">')
        return "\n".join([head, f"<title>{escape(self.title)}</title>", "<style>", self.style(),
                          "</style>", *self.elements, "</svg>", ""])
