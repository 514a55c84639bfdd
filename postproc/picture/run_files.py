# SPDX-License-Identifier: Apache-2.0
"""The files of a run: deck, frames, fields."""
import math
import os
import tomllib
import xml.etree.ElementTree as xml

import vtk

UNITS = {"velocity": "m/s", "displacement": "m", "stress": "Pa", "pressure": "Pa", "mass": "kg",
         "volume": "m\u00b3", "position": "m"}
NAMES = {"velocity": "speed"}  # what the magnitude of a vector is called


class Mistake(Exception):
    """What the user asked for cannot be done."""


def read_deck(run):
    """The resolved deck; an empty one if there is none."""
    try:
        with open(os.path.join(run, "resolved.toml"), "rb") as file:
            return tomllib.load(file)
    except FileNotFoundError:
        return {}
    except tomllib.TOMLDecodeError as error:
        raise Mistake(f"{run}/resolved.toml cannot be read: {error}") from error


def choose_frame(run, time):
    """Path and time of the last frame, or of the one nearest to `time`."""
    path = os.path.join(run, "particles.pvd")
    try:
        sets = xml.parse(path).getroot().iter("DataSet")
    except (OSError, xml.ParseError) as error:
        raise Mistake(f"{path} cannot be read: {error}") from error
    frames = [(float(item.get("timestep")), os.path.join(run, item.get("file"))) for item in sets]
    if not frames:
        raise Mistake(f"{path} lists no frames")
    found = frames[-1] if time is None else min(frames, key=lambda frame: abs(frame[0] - time))
    return found[1], found[0]


def read_frame(path):
    reader = vtk.vtkXMLUnstructuredGridReader()
    if not reader.CanReadFile(path):
        raise Mistake(f"{path} cannot be read")
    reader.SetFileName(path)
    reader.Update()
    data = reader.GetOutput()
    if data.GetNumberOfPoints() == 0:
        raise Mistake(f"{path} holds no particles")
    return data


def colour_values(data, field, component):
    """A scalar array to colour by, and its label."""
    points = data.GetPointData()
    array = points.GetArray(field)
    if array is None:
        names = ", ".join(points.GetArrayName(i) for i in range(points.GetNumberOfArrays()))
        raise Mistake(f"there is no field {field}; the frame has {names}")
    unit = f" ({UNITS[field]})" if field in UNITS else ""
    count = array.GetNumberOfComponents()
    if count == 1:
        return array, field.replace("_", " ") + unit
    result = vtk.vtkDoubleArray()
    result.SetNumberOfTuples(array.GetNumberOfTuples())
    if component is None:
        if count != 3:
            raise Mistake(f"{field} has {count} components; choose one with --component")
        for i in range(array.GetNumberOfTuples()):
            result.SetValue(i, math.sqrt(sum(x * x for x in array.GetTuple(i))))
        return result, NAMES.get(field, "|" + field + "|") + unit
    names = [array.GetComponentName(c) or str(c) for c in range(count)]
    if component.upper() not in names:
        raise Mistake(f"{field} has no component {component}; it has {', '.join(names)}")
    result.CopyComponent(0, array, names.index(component.upper()))
    return result, f"{field} {component.lower()}{unit}"
