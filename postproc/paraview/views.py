# SPDX-License-Identifier: Apache-2.0
"""The main views of a run in ParaView, each in a layout of its own: speed, strain, section, stress, free surface; with the
colliders where `scree post colliders` has written them.

    paraview --script=postproc/paraview/views.py          opens the run in the current folder
    pvbatch postproc/paraview/views.py RUN FOLDER         writes the views as pictures
    pvbatch postproc/paraview/views.py RUN FILE.pvsm      writes them as a state

The environment variable SCREE_RUN names another run folder for the first form.
"""
import os
import sys

from paraview.simple import *

HERE = os.path.dirname(os.path.abspath(__file__)) if "__file__" in globals() else os.path.join(os.getcwd(), "postproc/paraview")
# What each view needs: one of these fields.
VIEWS = (
    ("velocity", {"velocity"}),
    ("shear_strain", {"equivalent_plastic_strain", "equivalent_plastic_shear_strain"}),
    ("section", {"velocity"}),
    ("stress_glyphs", {"stress"}),
    ("free_surface", {"body"}),
)


def open_run(folder):
    """The particles of a run, in either format of its frames."""
    for name in ("particles.pvd", "particles.xdmf"):
        path = os.path.join(folder, name)
        if os.path.exists(path):
            return OpenDataFile(path)
    raise RuntimeError(f"{folder} holds no particles.pvd and no particles.xdmf")


def look_from_above(view):
    """From the front, the right and above, z up."""
    view.CameraPosition = [0.5, -1.0, 0.6]
    view.CameraFocalPoint = [0.0, 0.0, 0.0]
    view.CameraViewUp = [0.0, 0.0, 1.0]
    ResetCamera(view)


def show_views(run, pictures=None):
    """Makes the views of what the frames hold; returns their names."""
    source = open_run(run)
    times = list(source.TimestepValues) if hasattr(source.TimestepValues, "__len__") else [source.TimestepValues]
    if times:
        GetAnimationScene().AnimationTime = times[-1]
    source.UpdatePipeline(times[-1] if times else 0.0)
    fields = source.PointData.keys()
    flat = source.GetDataInformation().GetBounds()[4] == source.GetDataInformation().GetBounds()[5]
    colliders = os.path.exists(os.path.join(run, "colliders.pvd"))
    made = []
    for name, needed in VIEWS:
        if not needed & set(fields) or (name == "section" and flat):
            continue
        layout = CreateLayout("scree " + name)
        view = CreateView("RenderView")
        AssignViewToLayout(view, layout, 0)
        SetActiveView(view)
        SetActiveSource(source)
        for part in (name, "colliders") if colliders else (name,):
            with open(os.path.join(HERE, "macros", f"scree_{part}.py"), encoding="utf-8") as macro:
                exec(compile(macro.read(), macro.name, "exec"), {})
        if not flat and name != "section":
            look_from_above(view)
        if pictures:
            view.ViewSize = [1200, 900]
            SaveScreenshot(os.path.join(pictures, name + ".png"), view)
        made.append(name)
    return made


if len(sys.argv) > 2 and sys.argv[2].endswith(".pvsm"):
    show_views(sys.argv[1])
    SaveState(sys.argv[2])
elif len(sys.argv) > 2:
    os.makedirs(sys.argv[2], exist_ok=True)
    for view_name in show_views(sys.argv[1], sys.argv[2]):
        print(view_name)
else:
    show_views(os.environ.get("SCREE_RUN", os.getcwd()))
