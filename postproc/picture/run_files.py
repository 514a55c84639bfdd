# SPDX-License-Identifier: Apache-2.0
"""The files of a run: deck, frames, fields."""
import math
import os
import tomllib
import xml.etree.ElementTree as xml

import vtk

UNITS = {"velocity": "m/s", "displacement": "m", "position": "m", "mass": "kg", "volume": "m\u00b3", "strain_rate": "1/s",
         "seepage_velocity": "m/s", "lode_angle": "rad", "mobilised_friction": "rad",
         **dict.fromkeys(("stress", "pressure", "effective_stress", "pore_pressure", "p", "q", "von_mises", "principal_stress"), "Pa")}
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


def list_frames(run):
    """Path and time of every frame."""
    path = os.path.join(run, "particles.pvd")
    try:
        sets = xml.parse(path).getroot().iter("DataSet")
    except (OSError, xml.ParseError) as error:
        raise Mistake(f"{path} cannot be read: {error}") from error
    frames = [(os.path.join(run, item.get("file")), float(item.get("timestep"))) for item in sets]
    if not frames:
        raise Mistake(f"{path} lists no frames")
    return frames


def choose_frames(run, time, every):
    """All frames, the one nearest to `time`, or the last."""
    frames = list_frames(run)
    if every:
        return frames
    return [frames[-1] if time is None else min(frames, key=lambda frame: abs(frame[1] - time))]


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


def invariant(array, name):
    """Of a stress that is tension positive: p, the mean pressure, or q = von_mises, sqrt(3/2) |deviator|."""
    result = vtk.vtkDoubleArray()
    result.SetNumberOfTuples(array.GetNumberOfTuples())
    for i in range(array.GetNumberOfTuples()):
        s = array.GetTuple(i)
        mean = (s[0] + s[4] + s[8]) / 3
        q = math.sqrt(1.5 * sum((x - (mean if c % 4 == 0 else 0)) ** 2 for c, x in enumerate(s)))
        result.SetValue(i, -mean if name == "p" else q)
    return result


def colour_values(data, field, component, of_tensor=None):
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
    if of_tensor is not None:
        if count != 9:
            raise Mistake(f"{field} is no tensor and has no {of_tensor}")
        return invariant(array, of_tensor), f"{field} {of_tensor}{unit}"
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
