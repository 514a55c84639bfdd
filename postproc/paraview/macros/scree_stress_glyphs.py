# SPDX-License-Identifier: Apache-2.0
"""ParaView macro: ellipsoids of the stress at some particles of the active source; long where compression is large."""
from paraview.simple import *

source, view = GetActiveSource(), GetActiveViewOrCreate("RenderView")
if "stress" not in source.PointData.keys():
    raise RuntimeError("the frames have no field stress; add it to output.fields of the deck")
bounds = source.GetDataInformation().GetBounds()
largest = max(abs(x) for x in source.PointData["stress"].GetRange(-1)) or 1.0
size = max(b - a for a, b in zip(bounds[0::2], bounds[1::2]))
count = source.GetDataInformation().GetNumberOfPoints()
some = MaskPoints(Input=source, OnRatio=max(1, count // 500), GenerateVertices=1, SingleVertexPerCell=1)
glyphs = TensorGlyph(Input=some, GlyphType="Sphere", Tensors=["POINTS", "stress"], ScaleFactor=0.3 * size / largest)
glyphs.LimitScalingByEigenvalues = 1
glyphs.MaxScaleFactor = 0.05 * size
shown = GetDisplayProperties(source, view)
shown.Visibility = 0
Show(glyphs, view)
ResetCamera(view)
Render(view)
