# SPDX-License-Identifier: Apache-2.0
"""ParaView macro: the free surface of the active source: where half of the space around a point is filled, as in `scree post surface`."""
import os
import tomllib

from paraview.simple import *

source, view = GetActiveSource(), GetActiveViewOrCreate("RenderView")
reader = source
while not hasattr(reader, "FileName") and not hasattr(reader, "FileNames"):
    reader = reader.Input
name = reader.FileNames[0] if hasattr(reader, "FileNames") else reader.FileName
with open(os.path.join(os.path.dirname(os.path.abspath(str(name))), "resolved.toml"), "rb") as file:
    deck = tomllib.load(file)
domain = deck["domain"]
cell, dimension = domain["cell_size"], domain["dimension"]
volumes = [(cell / body.get("particles_per_direction", 2)) ** dimension for body in deck["body"].values()]

# Runs in ParaView for each time: every particle gives its volume to the corners of its cell.
SCRIPT = f"""
import numpy
from vtkmodules.numpy_interface import dataset_adapter
cell, dimension = {cell!r}, {dimension!r}
low, high = numpy.array({list(domain['lower'])!r}), numpy.array({list(domain['upper'])!r})
particles = dataset_adapter.WrapDataObject(self.GetInputDataObject(0, 0))
x = numpy.asarray(particles.Points)[:, :dimension]
field = particles.PointData
names = field.keys()
volume = numpy.asarray(field['volume'] if 'volume' in names else numpy.array({volumes!r})[numpy.asarray(field['body'])], dtype=float)
first = numpy.floor((x.min(axis=0) - low) / cell).astype(int) - 1
count = numpy.floor((x.max(axis=0) - low) / cell).astype(int) + 3 - first
share = numpy.zeros(count)
place = (x - low) / cell - first
base = numpy.floor(place).astype(int)
part = place - base
for corner in range(2 ** dimension):
    bits = [corner >> a & 1 for a in range(dimension)]
    weight = numpy.prod([part[:, a] if bit else 1 - part[:, a] for a, bit in enumerate(bits)], axis=0)
    numpy.add.at(share, tuple(base[:, a] + bit for a, bit in enumerate(bits)), weight * volume / cell ** dimension)
for a in range(dimension):  # the faces of the domain are mirrors
    for face in (0, int(round((high[a] - low[a]) / cell))):
        at = face - first[a]
        if 0 <= at < count[a]:
            index = [slice(None)] * dimension
            index[a] = at
            share[tuple(index)] *= 2
image = self.GetImageDataOutput()
sizes = list(count) + [1] * (3 - dimension)
extent = [value for size in sizes for value in (0, int(size) - 1)]
image.SetExtent(extent)
image.SetOrigin(*[low[a] + first[a] * cell if a < dimension else 0.0 for a in range(3)])
image.SetSpacing(cell, cell, cell)
dataset_adapter.WrapDataObject(image).PointData.append(share.ravel(order='F'), 'volume_fraction')
"""
EXTENT = f"""
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
import vtkmodules.vtkCommonDataModel
cells = [int(round((b - a) / {cell!r})) + 6 for a, b in zip({list(domain['lower'])!r}, {list(domain['upper'])!r})]
cells += [0] * (3 - len(cells))
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
