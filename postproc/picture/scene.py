# SPDX-License-Identifier: Apache-2.0
"""What is to be seen: box, particles, and from where."""
import math

import vtk

ROUND = 6  # pixels; smaller particles are drawn as squares, which leave no gaps
FAINT = (0.72, 0.72, 0.72)
# Points of the colour map viridis (public domain), dark to light in even steps.
VIRIDIS = [(0.267, 0.005, 0.329), (0.283, 0.141, 0.458), (0.254, 0.265, 0.530),
           (0.207, 0.372, 0.553), (0.164, 0.471, 0.558), (0.128, 0.567, 0.551),
           (0.135, 0.659, 0.518), (0.267, 0.749, 0.441), (0.478, 0.821, 0.318),
           (0.741, 0.873, 0.150), (0.993, 0.906, 0.144)]


class Scene:
    """Box, particle sizes and directions of a frame."""

    def __init__(self, deck, data, crop):
        domain = deck.get("domain", {})
        bounds = data.GetBounds()
        low, high = list(bounds[0::2]), list(bounds[1::2])
        flat = high[2] == low[2]
        self.dimension = domain.get("dimension", 2 if flat else 3)
        cell = domain.get("cell_size")
        if cell is None:  # a guess that fills the bounding box
            sizes = [high[i] - low[i] for i in range(self.dimension)]
            cell = (math.prod(sizes) / data.GetNumberOfPoints()) ** (1 / self.dimension) or 1.0
        self.sizes = [cell / body.get("particles_per_direction", 2) for body in deck.get("body", {}).values()] or [cell]
        if "lower" in domain and not crop:
            for i in range(self.dimension):
                low[i], high[i] = domain["lower"][i], domain["upper"][i]
        else:
            pad = max(self.sizes)
            low = [x - pad for x in low]
            high = [x + pad for x in high]
        self.low, self.high = low, high
        self.right, self.depth, self.up = self.directions(deck)

    def directions(self, deck):
        """The axes that point right, into the picture and up, the last against gravity; a sign with each."""
        gravity = deck.get("method", {}).get("gravity", [])
        acting = [i for i, g in enumerate(gravity) if str(g) not in ("0", "0.0", "-0.0")]
        up = acting[-1] if acting else 2
        return {0: ((1, 1), (2, 1), (0, 1)), 1: ((0, 1), (2, -1), (1, 1)), 2: ((0, 1), (1, 1), (2, 1))}[up]

    def corner(self, right, depth, up):
        """A corner of the box: 0 or 1 along each of the picture's directions."""
        point = [0.0, 0.0, 0.0]
        for (axis, sign), at in ((self.right, right), (self.depth, depth), (self.up, up)):
            upper = (at == 1) == (sign == 1)
            point[axis] = self.high[axis] if upper else self.low[axis]
        return point


def flat_view(scene, camera):
    middle = [(a + b) / 2 for a, b in zip(scene.low, scene.high)]
    camera.SetFocalPoint(*middle)
    camera.SetPosition(middle[0], middle[1], middle[2] + 1)
    camera.SetParallelScale((scene.high[1] - scene.low[1]) / 2)


def space_view(scene, camera):
    """Looks along `depth`, somewhat from the right and from above."""
    middle = [(a + b) / 2 for a, b in zip(scene.low, scene.high)]
    size = math.dist(scene.low, scene.high)
    position, up = list(middle), [0.0, 0.0, 0.0]
    for (axis, sign), share in ((scene.right, 0.5), (scene.depth, -1.0), (scene.up, 0.45)):
        position[axis] += sign * share * 3 * size
    up[scene.up[0]] = scene.up[1]
    camera.SetFocalPoint(*middle)
    camera.SetPosition(*position)
    camera.SetViewUp(*up)


def projected_box(scene, camera):
    """Extent of the box across the view: right and up, about the focal point [m]."""
    matrix = camera.GetViewTransformMatrix()
    corners = [scene.corner(r, d, u) for r in (0, 1) for d in (0, 1) for u in (0, 1)]
    across = [matrix.MultiplyPoint((*corner, 1.0))[:2] for corner in corners]
    return [max(p[i] for p in across) - min(p[i] for p in across) for i in (0, 1)]


def colour_function(low, high):
    function = vtk.vtkColorTransferFunction()
    for i, colour in enumerate(VIRIDIS):
        function.AddRGBPoint(low + (high - low) * i / (len(VIRIDIS) - 1), *colour)
    function.SetNanColor(*FAINT)  # materials without the field
    return function


def particle_actors(scene, data, values, function, pixels_per_metre):
    """One actor a body, for bodies may differ in particle size."""
    data.GetPointData().AddArray(values)
    values.SetName(values.GetName() or "colour")
    body = data.GetPointData().GetArray("body")
    groups = range(len(scene.sizes)) if body is not None else [None]
    for group in groups:
        source = data
        if group is not None:
            select = vtk.vtkThreshold()
            select.SetInputData(data)
            select.SetInputArrayToProcess(0, 0, 0, vtk.vtkDataObject.FIELD_ASSOCIATION_POINTS, "body")
            select.SetLowerThreshold(group)
            select.SetUpperThreshold(group)
            select.SetThresholdFunction(vtk.vtkThreshold.THRESHOLD_BETWEEN)
            select.Update()
            source = select.GetOutput()
        mapper = vtk.vtkDataSetMapper()
        mapper.SetInputData(source)
        mapper.SetScalarModeToUsePointFieldData()
        mapper.SelectColorArray(values.GetName())
        mapper.SetLookupTable(function)
        mapper.UseLookupTableScalarRangeOn()
        actor = vtk.vtkActor()
        actor.SetMapper(mapper)
        flat = scene.dimension == 2
        # Wider than the particles' distance, to close the gaps of a moderately deformed body.
        size = (2.0 if flat else 1.25) * scene.sizes[group or 0] * pixels_per_metre
        style = actor.GetProperty()
        style.SetPointSize(max(1.5, size))
        style.SetRenderPointsAsSpheres(size > ROUND)
        style.SetAmbient(1.0 if flat else 0.35)
        style.SetDiffuse(0.0 if flat else 0.7)
        yield actor


def box_edges(scene):
    box = vtk.vtkOutlineSource()
    box.SetBounds(*(x for pair in zip(scene.low, scene.high) for x in pair))
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(box.GetOutputPort())
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(*FAINT)
    actor.GetProperty().SetLineWidth(1.5)
    actor.GetProperty().LightingOff()
    return actor
