# SPDX-License-Identifier: Apache-2.0
"""The page: where things stand, lines and text, axes and the colour bar."""
import math

import vtk

INK = (0.13, 0.13, 0.13)


def ticks(low, high, most):
    """Round numbers in [low, high], at most about `most` of them, and their text."""
    if not high > low:
        return [(low, f"{low:.3g}")]
    rough = (high - low) / most
    power = 10.0 ** math.floor(math.log10(rough))
    step = next(f * power for f in (1, 2, 5, 10) if f * power >= rough * (1 - 1e-9))
    digits = max(0, -math.floor(math.log10(step) + 1e-9))
    values = [i * step for i in range(math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9) + 1)]
    if digits <= 4 and max(abs(low), abs(high)) < 1e5:
        return [(v, f"{v:.{digits}f}") for v in values]
    return [(v, scientific(v, step)) for v in values]


def scientific(value, step):
    """As many digits as tell neighbours at the distance `step` apart."""
    if abs(value) < 0.5 * step:
        return "0"
    places = [math.floor(math.log10(abs(x)) + 1e-9) for x in (value, step)]
    return f"{value:.{max(0, places[0] - places[1])}e}"


class Paper:
    """Lines and text over the picture, in pixels from the lower left corner."""

    def __init__(self, renderer, scale):
        self.renderer = renderer
        self.scale = scale

    def text(self, x, y, words, size=22, align="left", valign="bottom", bold=False, turn=0):
        actor = vtk.vtkTextActor()
        actor.SetInput(words)
        style = actor.GetTextProperty()
        style.SetFontFamilyToArial()
        style.SetFontSize(round(size * self.scale))
        style.SetColor(*INK)
        style.SetBold(bold)
        style.SetOrientation(turn)
        {"left": style.SetJustificationToLeft, "center": style.SetJustificationToCentered,
         "right": style.SetJustificationToRight}[align]()
        {"bottom": style.SetVerticalJustificationToBottom, "middle": style.SetVerticalJustificationToCentered,
         "top": style.SetVerticalJustificationToTop}[valign]()
        actor.GetPositionCoordinate().SetCoordinateSystemToDisplay()
        actor.SetPosition(x, y)
        self.renderer.AddActor2D(actor)

    def line(self, a, b, colour=INK, width=2):
        self.shape([a, b], colour, width)

    def shape(self, points, colour, width=0):
        """A line of two points, or a filled polygon (width 0)."""
        corners, cells = vtk.vtkPoints(), vtk.vtkCellArray()
        cells.InsertNextCell(len(points))
        for x, y in points:
            cells.InsertCellPoint(corners.InsertNextPoint(x, y, 0))
        data = vtk.vtkPolyData()
        data.SetPoints(corners)
        (data.SetLines if width else data.SetPolys)(cells)
        mapper = vtk.vtkPolyDataMapper2D()
        mapper.SetInputData(data)
        actor = vtk.vtkActor2D()
        actor.SetMapper(mapper)
        actor.GetProperty().SetColor(*colour)
        actor.GetProperty().SetLineWidth(max(1, width * self.scale))
        self.renderer.AddActor2D(actor)


class Layout:
    """Where things stand on the page, in pixels."""

    def __init__(self, width, box_width, box_height, flat):
        self.scale = s = width / 1600
        self.width = width
        self.left, self.right, self.bottom, self.top = (140 if flat else 190) * s, 250 * s, 115 * s, 110 * s
        room = width - self.left - self.right
        self.plot_width = min(room, 1200 * s * box_width / box_height)
        self.plot_height = self.plot_width * box_height / box_width
        self.left += (room - self.plot_width) / 2
        self.page_height = max(self.plot_height, 260 * s)
        self.height = round(self.page_height + self.bottom + self.top)
        self.bottom += (self.page_height - self.plot_height) / 2

    def bar(self):
        s = self.scale
        left = self.width - 220 * s
        middle = self.bottom + self.plot_height / 2
        half = min(max(self.plot_height, 260 * s) / 2 - 30 * s, 260 * s)
        return left, middle - half - 10 * s, left + 34 * s, middle + half - 10 * s

    def viewport(self):
        return (self.left / self.width, self.bottom / self.height,
                (self.left + self.plot_width) / self.width, (self.bottom + self.plot_height) / self.height)


def in_two_lines(words, most):
    """Breaks a text of more than `most` characters at the space nearest to its middle."""
    spaces = [i for i, c in enumerate(words) if c == " "]
    if len(words) <= most or not spaces:
        return words
    middle = min(spaces, key=lambda i: abs(i - len(words) / 2))
    return words[:middle] + "\n" + words[middle + 1:]


def add_colour_bar(paper, box, function, shown, all_values, label, notes):
    """A bar in the pixel box (left, bottom, right, top) with ticks to its right and notes below.

    `shown` is the range of the colours; where `all_values` goes beyond it, a note says so.
    """
    left, bottom, right, top = box
    low, high = shown
    steps = 128
    for i in range(steps):
        y0, y1 = (bottom + (top - bottom) * (i + d) / steps for d in (0, 1))
        colour = function.GetColor(low + (high - low) * (i + 0.5) / steps)
        paper.shape([(left, y0), (right, y0), (right, y1 + 1), (left, y1 + 1)], colour)
    corners = [(left, bottom), (right, bottom), (right, top), (left, top)]
    for a, b in zip(corners, corners[1:] + corners[:1]):
        paper.line(a, b, width=1.5)
    s = paper.scale
    for value, words in ticks(low, high, 5):
        y = bottom + (top - bottom) * (value - low) / (high - low)
        paper.line((right, y), (right + 7 * s, y), width=1.5)
        paper.text(right + 13 * s, y, words, valign="middle")
    paper.text(left, top + 16 * s, in_two_lines(label, 18))
    beyond = [f"{name} {value:.2g}" for name, value, outside in
              (("min", all_values[0], all_values[0] < low), ("max", all_values[1], all_values[1] > high)) if outside]
    lines = ([", ".join(beyond)] if beyond else []) + notes
    if lines:
        paper.text(left, bottom - 14 * s, "\n".join(lines), size=18, valign="top")


def add_flat_axes(paper, layout, scene):
    s, x0, y0 = layout.scale, layout.left, layout.bottom
    x1, y1 = x0 + layout.plot_width, y0 + layout.plot_height
    for a, b in (((x0, y0), (x1, y0)), ((x1, y0), (x1, y1)), ((x1, y1), (x0, y1)), ((x0, y1), (x0, y0))):
        paper.line(a, b)
    metre = layout.plot_width / (scene.high[0] - scene.low[0])
    for value, words in ticks(scene.low[0], scene.high[0], max(2, layout.plot_width / (140 * s))):
        x = x0 + (value - scene.low[0]) * metre
        paper.line((x, y0), (x, y0 - 8 * s))
        paper.text(x, y0 - 14 * s, words, align="center", valign="top")
    for value, words in ticks(scene.low[1], scene.high[1], max(2, layout.plot_height / (80 * s))):
        y = y0 + (value - scene.low[1]) * metre
        paper.line((x0, y), (x0 - 8 * s, y))
        paper.text(x0 - 14 * s, y, words, align="right", valign="middle")
    paper.text((x0 + x1) / 2, y0 - 52 * s, "x (m)", size=24, align="center", valign="top")
    paper.text(x0 - 96 * s, (y0 + y1) / 2, "y (m)", size=24, align="center", valign="middle", turn=90)


def add_space_axes(paper, layout, scene, renderer):
    """Ticks on the three edges that bound the box in the picture: front bottom, right bottom, left."""
    s = layout.scale

    def on_page(point):
        renderer.SetWorldPoint(*point, 1.0)
        renderer.WorldToDisplay()
        return renderer.GetDisplayPoint()[:2]

    edges = ((scene.right[0], scene.corner(0, 0, 0), scene.corner(1, 0, 0), (-0.25, -0.97), "right"),
             (scene.depth[0], scene.corner(1, 0, 0), scene.corner(1, 1, 0), (0.8, -0.6), "left"),
             (scene.up[0], scene.corner(0, 0, 0), scene.corner(0, 0, 1), (-1.0, 0.0), "right"))
    for axis, start, end, (ox, oy), align in edges:
        a, b = on_page(start), on_page(end)
        paper.line(a, b)
        length = math.dist(a, b)
        low, high = sorted((start[axis], end[axis]))
        for value, words in ticks(low, high, max(2, length / (150 * s))):
            point = list(start)
            point[axis] = value
            x, y = on_page(point)
            paper.line((x, y), (x + 8 * s * ox, y + 8 * s * oy))
            paper.text(x + 14 * s * ox, y + 12 * s * oy, words, align=align, valign="middle" if oy == 0 else "top")
        x, y = (a[0] + b[0]) / 2, (a[1] + b[1]) / 2
        paper.text(x + 88 * s * ox, y + 78 * s * oy, "xyz"[axis] + " (m)", size=24, align=align, valign="middle")
