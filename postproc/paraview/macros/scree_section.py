# SPDX-License-Identifier: Apache-2.0
"""ParaView macro: a slab of particles through the middle of the active source, normal to y (change it in Properties)."""
from paraview.simple import *

source, view = GetActiveSource(), GetActiveViewOrCreate("RenderView")
bounds = source.GetDataInformation().GetBounds()
count = max(1, source.GetDataInformation().GetNumberOfPoints())
middle = [(a + b) / 2 for a, b in zip(bounds[0::2], bounds[1::2])]
sides = [b - a for a, b in zip(bounds[0::2], bounds[1::2]) if b > a] or [1.0]
volume = 1.0
for side in sides:
    volume *= side
spacing = (volume / count) ** (1 / len(sides))
shown = GetDisplayProperties(source, view)
shown.Visibility = 0
slab = source
for sign in (1, -1):  # two half spaces leave the slab between them
    clip = Clip(Input=slab, ClipType="Plane")
    clip.ClipType.Origin = [middle[0], middle[1] + sign * 2 * spacing, middle[2]]
    clip.ClipType.Normal = [0, sign, 0]
    clip.Invert = 1
    slab = clip
display = Show(slab, view)
display.SetRepresentationType("Point Gaussian")
display.GaussianRadius = 0.6 * spacing
ColorBy(display, ("POINTS", "velocity", "Magnitude"))
display.RescaleTransferFunctionToDataRange(False, True)
display.SetScalarBarVisibility(view, True)
view.CameraPosition = [middle[0], middle[1] - 1, middle[2]]
view.CameraFocalPoint = middle
view.CameraViewUp = [0, 0, 1]
ResetCamera(view)
Render(view)
