# SPDX-License-Identifier: Apache-2.0
"""ParaView macro: the free surface of the active source: where half of the space around a point is filled, as in `scree post surface`."""
import os

from paraview.simple import *

source, view = GetActiveSource(), GetActiveViewOrCreate("RenderView")

# The run that the particles come from, perhaps behind filters.
reader = source
while not hasattr(reader, "FileName") and not hasattr(reader, "FileNames"):
    above = reader.Input
    reader = above[0] if hasattr(above, "__len__") else above
name = reader.FileNames if hasattr(reader, "FileNames") else reader.FileName
name = name if isinstance(name, str) else name[0]

# The scripts run in ParaView's pipeline, for each time; they ask the reader for the run's folder, so that a saved state serves other runs. The
# reader of XDMF files does not tell it: there it is the run of now.
COMMON = f"folder_of_now = {os.path.dirname(os.path.abspath(name))!r}\n" + """
def deck_of(algorithm):
    import os
    import tomllib
    while algorithm is not None:
        for ask in (lambda a: a.GetFileName(), lambda a: a.GetFileName(0), lambda a: a.GetReader().GetFileName()):
            try:
                name = ask(algorithm)
            except (AttributeError, TypeError):
                continue
            if name:
                with open(os.path.join(os.path.dirname(os.path.abspath(name)), "resolved.toml"), "rb") as file:
                    return tomllib.load(file)
        algorithm = algorithm.GetInputAlgorithm(0, 0) if algorithm.GetNumberOfInputPorts() else None
    with open(os.path.join(folder_of_now, "resolved.toml"), "rb") as file:
        return tomllib.load(file)


deck = deck_of(self.GetInputAlgorithm(0, 0))
domain = deck["domain"]
cell, dimension = domain["cell_size"], domain["dimension"]
"""
SCRIPT = COMMON + """
import numpy
from vtkmodules.numpy_interface import dataset_adapter
low, high = numpy.array(domain["lower"]), numpy.array(domain["upper"])
particles = dataset_adapter.WrapDataObject(self.GetInputDataObject(0, 0))
x = numpy.asarray(particles.Points)[:, :dimension]
field = particles.PointData
if "volume" in field.keys():
    volume = numpy.asarray(field["volume"], dtype=float)
else:
    of_body = numpy.array([(cell / body.get("particles_per_direction", 2)) ** dimension for body in deck["body"].values()])
    volume = of_body[numpy.asarray(field["body"])]
# Every particle gives its volume to the corners of its cell.
first = numpy.floor((x.min(axis=0) - low) / cell).astype(int) - 1
count = numpy.floor((x.max(axis=0) - low) / cell).astype(int) + 3 - first
share = numpy.zeros(count)
place = (x - low) / cell - first
base = numpy.floor(place).astype(int)
part = place - base
for corner in range(2 ** dimension):
    bits = [corner >> a & 1 for a in range(dimension)]
    weight = volume / cell ** dimension
    for a in range(dimension):
        weight = weight * (part[:, a] if bits[a] else 1 - part[:, a])
    numpy.add.at(share, tuple((base + bits).T), weight)
for a in range(dimension):  # the faces of the domain are mirrors
    for face in (0, int(round((high[a] - low[a]) / cell))):
        at = face - first[a]
        if 0 <= at < count[a]:
            index = [slice(None)] * dimension
            index[a] = at
            share[tuple(index)] *= 2
image = self.GetImageDataOutput()
sizes = list(count) + [1] * (3 - dimension)
image.SetExtent(0, int(sizes[0]) - 1, 0, int(sizes[1]) - 1, 0, int(sizes[2]) - 1)
origin = list(low + first * cell) + [0.0] * (3 - dimension)
image.SetOrigin(*origin)
image.SetSpacing(cell, cell, cell)
dataset_adapter.WrapDataObject(image).PointData.append(share.ravel(order="F"), "volume_fraction")
"""
EXTENT = COMMON + """
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
cells = [int(round((b - a) / cell)) + 6 for a, b in zip(domain["lower"], domain["upper"])] + [0] * (3 - dimension)
info = self.GetOutputInformation(0)
info.Set(vtkStreamingDemandDrivenPipeline.WHOLE_EXTENT(), 0, cells[0], 0, cells[1], 0, cells[2])
"""
fraction = ProgrammableFilter(Input=source, OutputDataSetType="vtkImageData", Script=SCRIPT, RequestInformationScript=EXTENT)
surface = Contour(Input=fraction, ContourBy=["POINTS", "volume_fraction"], Isosurfaces=[0.5], ComputeScalars=0)
GetDisplayProperties(source, view).Visibility = 0
display = Show(surface, view)
display.ColorArrayName = ["POINTS", ""]
display.DiffuseColor = display.AmbientColor = [0.55, 0.45, 0.3]
display.LineWidth = 3
ResetCamera(view)
Render(view)
