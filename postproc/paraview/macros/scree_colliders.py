# SPDX-License-Identifier: Apache-2.0
"""ParaView macro: the colliders and the terrain of the active source's run, which `scree post colliders RUN` has written."""
import os

from paraview.simple import *

source, view = GetActiveSource(), GetActiveViewOrCreate("RenderView")
reader = source
while not hasattr(reader, "FileName") and not hasattr(reader, "FileNames"):
    above = reader.Input
    reader = above[0] if hasattr(above, "__len__") else above
name = reader.FileNames if hasattr(reader, "FileNames") else reader.FileName
name = name if isinstance(name, str) else name[0]
index = os.path.join(os.path.dirname(os.path.abspath(name)), "colliders.pvd")
if not os.path.exists(index):
    raise RuntimeError(f"there is no {index}; `scree post colliders` with the run folder writes it")
colliders = FindSource("colliders") or OpenDataFile(index, registrationName="colliders")
display = Show(colliders, view)
display.SetRepresentationType("Surface")
display.ColorArrayName = ["POINTS", ""]
display.DiffuseColor = display.AmbientColor = [0.6, 0.6, 0.62]
display.Opacity = 0.35
SetActiveSource(source)
Render(view)
