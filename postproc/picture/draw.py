# SPDX-License-Identifier: Apache-2.0
"""Puts the picture together and writes it."""
import math
import os

import vtk

from picture.page import Layout, Paper, add_colour_bar, add_flat_axes, add_space_axes
from picture.run_files import Mistake, choose_frame, colour_values, read_deck, read_frame
from picture.scene import (Scene, box_edges, colour_function, flat_view, particle_actors, projected_box,
                           space_view)


def colour_range(values, asked):
    """The range of the colours: as asked, or of the values, from zero where they are not negative.

    A few extreme particles would leave all others in one colour: the range then ends at the
    outermost percent, and what lies beyond takes the last colour.
    """
    if asked:
        if not asked[1] > asked[0]:
            raise Mistake(f"--range {asked[0]:g} {asked[1]:g}: LOW must be below HIGH")
        return tuple(asked)
    if not values:
        return (0.0, 1.0)
    ordered = sorted(values)
    low, high = (ordered[round(share * (len(ordered) - 1))] for share in (0.01, 0.99))
    if ordered[-1] - ordered[0] < 1.5 * (high - low):
        low, high = ordered[0], ordered[-1]
    if ordered[0] >= 0:
        low = 0.0
    return (low, high) if high > low else (low, low + 1.0)


def draw(options):
    deck = read_deck(options.run)
    path, time = choose_frame(options.run, options.time)
    data = read_frame(path)
    values, label = colour_values(data, options.field, options.component)
    numbers = [x for x in map(values.GetValue, range(values.GetNumberOfTuples())) if not math.isnan(x)]
    low, high = colour_range(numbers, options.range)
    function = colour_function(low, high)
    scene = Scene(deck, data, options.crop)
    flat = scene.dimension == 2

    renderer, overlay = vtk.vtkRenderer(), vtk.vtkRenderer()
    layout, pixels_per_metre = place(scene, renderer, options.width)
    for actor in particle_actors(scene, data, values, function, pixels_per_metre):
        renderer.AddActor(actor)
    if not flat:
        renderer.AddActor(box_edges(scene))
    renderer.ResetCameraClippingRange()
    window = open_window(layout, renderer, overlay)

    paper = Paper(overlay, layout.scale)
    if flat:
        add_flat_axes(paper, layout, scene)
    else:
        add_space_axes(paper, layout, scene, renderer)
    extremes = (min(numbers), max(numbers)) if numbers else (low, high)
    notes = ["grey: no value"] if len(numbers) < values.GetNumberOfTuples() else []
    add_colour_bar(paper, layout.bar(), function, (low, high), extremes, label, notes)
    title = options.title
    if title is None:
        title = deck.get("title", "") or os.path.basename(os.path.abspath(options.run))
    s = layout.scale
    paper.text(44 * s, layout.height - 32 * s, title, size=30, valign="top", bold=True)
    paper.text(layout.width - 44 * s, layout.height - 34 * s, f"t = {time:.6g} s", size=28, align="right", valign="top")
    window.Render()
    save(window, options.output)


def place(scene, renderer, width):
    """Sets the camera and its part of the page; returns the layout and pixels per metre."""
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    flat = scene.dimension == 2
    (flat_view if flat else space_view)(scene, camera)
    wide, tall = projected_box(scene, camera)
    camera.SetParallelScale(tall / 2)
    layout = Layout(width, wide, tall, flat)
    renderer.SetViewport(*layout.viewport())
    renderer.SetBackground(1, 1, 1)
    return layout, layout.plot_height / tall


def open_window(layout, renderer, overlay):
    page = vtk.vtkRenderer()  # white under everything
    page.SetBackground(1, 1, 1)
    overlay.SetLayer(1)
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(8)
    window.SetSize(layout.width, layout.height)
    window.SetNumberOfLayers(2)
    for part in (page, renderer, overlay):
        window.AddRenderer(part)
    return window


def save(window, path):
    folder = os.path.dirname(os.path.abspath(path))
    if not os.access(folder, os.W_OK):
        raise Mistake(f"cannot write into {folder}")
    image = vtk.vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(path)
    writer.SetInputConnection(image.GetOutputPort())
    writer.Write()
    if writer.GetErrorCode() != 0 or not os.path.exists(path):
        raise Mistake(f"cannot write {path}")
