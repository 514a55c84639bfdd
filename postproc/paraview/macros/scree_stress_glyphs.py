# SPDX-License-Identifier: Apache-2.0
"""ParaView macro: ellipsoids of the stress at some particles of the active source; long where compression is large."""
from paraview.simple import *

source, view = GetActiveSource(), GetActiveViewOrCreate("RenderView")
if "stress" not in source.PointData.keys():
    raise RuntimeError("the frames have no field stress; add it to output.fields of the deck")
bounds = source.GetDataInformation().GetBounds()
size = max(b - a for a, b in zip(bounds[0::2], bounds[1::2]))
count = source.GetDataInformation().GetNumberOfPoints()
some = MaskPoints(Input=source, OnRatio=max(1, count // 400), RandomSampling=1, GenerateVertices=1, SingleVertexPerCell=1)
# A few large stresses must not make all others vanish: nine of ten glyphs have their true size.
array = servermanager.Fetch(some).GetPointData().GetArray("stress")
norms = sorted(sum(x * x for x in array.GetTuple(i)) ** 0.5 for i in range(array.GetNumberOfTuples()))
typical = (norms[int(0.9 * (len(norms) - 1))] if norms else 0.0) or 1.0
glyphs = TensorGlyph(Input=some, GlyphType="Sphere", Tensors=["POINTS", "stress"], ScaleFactor=0.06 * size / typical)
glyphs.LimitScalingByEigenvalues = 1
glyphs.MaxScaleFactor = 0.08 * size
shown = Show(source, view)
shown.SetRepresentationType("Outline")
display = Show(glyphs, view)
display.ColorArrayName = ["POINTS", ""]
display.DiffuseColor = display.AmbientColor = [0.85, 0.55, 0.25]
ResetCamera(view)
Render(view)
