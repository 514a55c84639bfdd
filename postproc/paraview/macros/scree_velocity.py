# SPDX-License-Identifier: Apache-2.0
"""ParaView macro: the particles of the active source, coloured by speed."""
from paraview.simple import *

source, view = GetActiveSource(), GetActiveViewOrCreate("RenderView")
bounds = source.GetDataInformation().GetBounds()
count = max(1, source.GetDataInformation().GetNumberOfPoints())
sides = [b - a for a, b in zip(bounds[0::2], bounds[1::2]) if b > a] or [1.0]
volume = 1.0
for side in sides:
    volume *= side
display = Show(source, view)
display.SetRepresentationType("Point Gaussian")
display.GaussianRadius = 0.6 * (volume / count) ** (1 / len(sides))
ColorBy(display, ("POINTS", "velocity", "Magnitude"))
display.RescaleTransferFunctionToDataRange(False, True)
display.SetScalarBarVisibility(view, True)
ResetCamera(view)
Render(view)
