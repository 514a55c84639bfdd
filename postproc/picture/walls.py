# SPDX-License-Identifier: Apache-2.0
"""What holds the particles: colliders, terrain, and faces of the domain."""
import os
import xml.etree.ElementTree as xml

import vtk

from picture.run_files import Mistake

STEEL = (0.55, 0.58, 0.62)
EARTH = (0.74, 0.68, 0.60)
EDGE = (0.25, 0.27, 0.30)
COMBINED = ("union", "difference", "intersection")  # their surfaces follow a lattice, and so would their edges
HOLDING = ("sticky", "slip", "separate", "friction")  # faces that are walls


def collider_surfaces(index, time):
    """The surfaces that a .pvd file names for a time, by their places in the deck."""
    try:
        sets = list(xml.parse(index).getroot().iter("DataSet"))
    except (OSError, xml.ParseError) as error:
        raise Mistake(f"{index} cannot be read: {error}") from error
    if not sets:
        return {}
    nearest = min((float(item.get("timestep")) for item in sets), key=lambda t: abs(t - time))
    surfaces = {}
    for item in sets:
        if float(item.get("timestep")) != nearest:
            continue
        reader = vtk.vtkXMLPolyDataReader()
        reader.SetFileName(os.path.join(os.path.dirname(index), item.get("file")))
        reader.Update()
        surfaces[int(item.get("part"))] = reader.GetOutput()
    return surfaces


def within_box(data, scene):
    """What of a surface lies in the box, or just outside."""
    size = max(b - a for a, b in zip(scene.low, scene.high))
    for axis in range(3):
        for sign, limit in ((1, scene.high[axis]), (-1, scene.low[axis])):
            plane = vtk.vtkPlane()
            plane.SetOrigin(*(limit + sign * 1e-4 * size if i == axis else 0 for i in range(3)))
            plane.SetNormal(*(-sign if i == axis else 0 for i in range(3)))
            cut = vtk.vtkClipPolyData()
            cut.SetInputData(data)
            cut.SetClipFunction(plane)
            cut.Update()
            data = cut.GetOutput()
    return data


def actor_of(data, scene, colour, opacity):
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(data)
    mapper.ScalarVisibilityOff()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.SetScale(*scene.stretch)
    actor.GetProperty().SetColor(*colour)
    actor.GetProperty().SetOpacity(opacity)
    return actor


def part(data, polygons):
    """The polygons of a surface alone, or its lines."""
    result = vtk.vtkPolyData()
    result.SetPoints(data.GetPoints())
    (result.SetPolys if polygons else result.SetLines)(data.GetPolys() if polygons else data.GetLines())
    return result


def collider_actors(scene, deck, index, time, opacity):
    """Colliders where they stand at a time: in 2D areas with outlines, in 3D surfaces."""
    shapes = [item.get("shape", {}).get("type") for item in deck.get("collider", {}).values()]
    for place, data in collider_surfaces(index, time).items():
        if data.GetNumberOfPoints() == 0:
            continue
        terrain = shapes[place] == "heightmap"
        colour = EARTH if terrain else STEEL
        if scene.dimension == 2:
            yield from flat_actors(scene, data, colour, opacity)
            continue
        data = within_box(data, scene)
        if data.GetNumberOfCells() == 0:
            continue
        smooth = vtk.vtkPolyDataNormals()
        smooth.SetInputData(data)
        smooth.SetFeatureAngle(30)
        smooth.Update()
        actor = actor_of(smooth.GetOutput(), scene, colour, opacity or (1 if terrain and not scene.flat else 0.35))
        style = actor.GetProperty()
        style.SetAmbient(0.35)
        style.SetDiffuse(0.7)
        yield actor
        if not terrain and shapes[place] not in COMBINED:
            yield sharp_edges(data, scene)


def flat_actors(scene, data, colour, opacity):
    fill = vtk.vtkTriangleFilter()  # polygons may have corners that point inward
    fill.SetInputData(part(data, True))
    fill.Update()
    above = 1e-3 * max(b - a for a, b in zip(scene.low, scene.high))  # the particles' plane
    for piece, shade, cover, lift in ((fill.GetOutput(), colour, opacity or 0.35, 1), (part(data, False), EDGE, 1, 2)):
        actor = actor_of(piece, scene, shade, cover)
        actor.SetPosition(0, 0, lift * above)
        actor.GetProperty().LightingOff()
        actor.GetProperty().SetLineWidth(2.5)
        yield actor


def sharp_edges(data, scene):
    edges = vtk.vtkFeatureEdges()
    edges.SetInputData(data)
    edges.SetFeatureAngle(40)
    edges.ManifoldEdgesOff()
    edges.NonManifoldEdgesOff()
    edges.ColoringOff()
    edges.Update()
    actor = actor_of(edges.GetOutput(), scene, EDGE, 0.8)
    actor.GetProperty().SetLineWidth(1.5)
    actor.GetProperty().LightingOff()
    return actor


def face_types(deck, dimension):
    """(axis, side, type) of every face of the domain; side 0 is the lower one."""
    faces = deck.get("boundary", {})
    for axis in range(dimension):
        for side, ending in enumerate(("min", "max")):
            face = faces.get(f"{'xyz'[axis]}_{ending}", "open")
            yield axis, side, face.get("type", "open") if isinstance(face, dict) else face


def face_actors(scene, deck):
    """In 3D the faces that hold particles, seen from inside: never between the eye and the particles."""
    for axis, side, kind in face_types(deck, 3):
        if kind not in HOLDING:
            continue
        limit = deck.get("domain", {}).get("upper" if side else "lower", [None] * 3)[axis]
        bound = (scene.high if side else scene.low)[axis]
        if limit is None or abs(limit - bound) > 1e-9 * abs(scene.high[axis] - scene.low[axis]):
            continue  # the picture is cropped: the face is not in it
        other = [i for i in range(3) if i != axis]
        points, cells = vtk.vtkPoints(), vtk.vtkCellArray()
        cells.InsertNextCell(4)
        corners = ((0, 0), (1, 0), (1, 1), (0, 1))
        # Counter-clockwise seen from outside, as axis 1 turns the order of the other two.
        for u, v in corners if bool(side) != (axis == 1) else reversed(corners):
            x = [bound] * 3
            x[other[0]] = (scene.low, scene.high)[u][other[0]]
            x[other[1]] = (scene.low, scene.high)[v][other[1]]
            cells.InsertCellPoint(points.InsertNextPoint(*x))
        data = vtk.vtkPolyData()
        data.SetPoints(points)
        data.SetPolys(cells)
        actor = actor_of(data, scene, STEEL, 0.14)
        actor.GetProperty().FrontfaceCullingOn()
        actor.GetProperty().LightingOff()
        yield actor


def add_flat_faces(paper, layout, scene, deck):
    """Faces that hold particles as walls with hatching outside, planes of symmetry dash-dotted, periodic ones dashed."""
    s = layout.scale
    x0, y0 = layout.left, layout.bottom
    x1, y1 = x0 + layout.plot_width, y0 + layout.plot_height
    for axis, side, kind in face_types(deck, scene.dimension):
        limit = deck.get("domain", {}).get("upper" if side else "lower", [None] * 3)[axis]
        bound = (scene.high if side else scene.low)[axis]
        if limit is None or abs(limit - bound) > 1e-9 * abs(scene.high[axis] - scene.low[axis]):
            continue
        for direction, ends in ((scene.across, (((x0, y0), (x0, y1)), ((x1, y0), (x1, y1)))),
                                (scene.upward, (((x0, y0), (x1, y0)), ((x0, y1), (x1, y1))))):
            if direction[0] != axis:
                continue
            far = (side == 1) == (direction[1] > 0)
            draw_face(paper, *ends[far], outward=1 if far else -1, kind=kind, s=s)


def draw_face(paper, a, b, outward, kind, s):
    upright = a[0] == b[0]
    length = (b[1] - a[1]) if upright else (b[0] - a[0])

    def at(along, out):
        return (a[0] + outward * out, a[1] + along) if upright else (a[0] + along, a[1] + outward * out)

    if kind in HOLDING:
        paper.line(a, b, width=4)
        step = 14 * s
        for i in range(int(length / step)):
            paper.line(at(i * step, 7 * s), at((i + 1) * step, 0), width=1)
    elif kind in ("symmetry", "periodic"):
        pattern = (22, 6, 4, 6) if kind == "symmetry" else (12, 10)
        place, i = 0.0, 0
        while place < length:
            end = min(place + pattern[i % len(pattern)] * s, length)
            if i % 2 == 0:
                paper.line(at(place, 0), at(end, 0), width=5)
            place, i = end, i + 1
