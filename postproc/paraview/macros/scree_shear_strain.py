# SPDX-License-Identifier: Apache-2.0
"""ParaView macro: the particles of the active source, coloured by the equivalent plastic strain that the frames hold."""
from paraview.simple import *

source, view = GetActiveSource(), GetActiveViewOrCreate("RenderView")
strains = [name for name in ("equivalent_plastic_strain", "equivalent_plastic_shear_strain") if name in source.PointData.keys()]
if not strains:
    raise RuntimeError("the frames have no plastic strain; add equivalent_plastic_shear_strain to output.fields of the deck")
bounds = source.GetDataInformation().GetBounds()
count = max(1, source.GetDataInformation().GetNumberOfPoints())
sides = [b - a for a, b in zip(bounds[0::2], bounds[1::2]) if b > a] or [1.0]
volume = 1.0
for side in sides:
    volume *= side
display = Show(source, view)
display.SetRepresentationType("Point Gaussian")
display.GaussianRadius = 0.6 * (volume / count) ** (1 / len(sides))
ColorBy(display, ("POINTS", strains[0]))
display.RescaleTransferFunctionToDataRange(False, True)
display.SetScalarBarVisibility(view, True)
ResetCamera(view)
Render(view)
