# SPDX-License-Identifier: Apache-2.0
"""Puts the picture together and writes it."""
import math
import os
import shutil
import subprocess
import sys
import tempfile

import vtk

from picture.page import Layout, Paper, add_colour_bar, add_flat_axes, add_space_axes
from picture.run_files import Mistake, choose_frames, colour_values, read_deck, read_frame
from picture.scene import (Scene, box_edges, colour_function, flat_view, particle_actors, projected_box,
                           space_view)
from picture.walls import add_flat_faces, collider_actors, face_actors


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
    """One picture, one a frame, or a film, by the options and the name of the output."""
    film = options.output.lower().endswith(".mp4")
    if film and not shutil.which("ffmpeg"):
        raise Mistake("films need ffmpeg, which is not installed (Debian: apt-get install ffmpeg); "
                      "-o NAME.png --all writes the frames as pictures")
    if not film and not options.output.lower().endswith(".png"):
        raise Mistake(f"-o {options.output}: the name must end in .png or .mp4")
    if not options.exaggeration > 0:
        raise Mistake("--exaggeration must be above 0")
    frames = choose_frames(options.run, options.time, options.all or film)
    deck = read_deck(options.run)
    if len(frames) > 1 and options.range is None:
        options.range = range_of_all(frames, options)
    if not film:
        for i, (path, time) in enumerate(frames):
            base = options.output[:-4]
            draw_frame(options, deck, path, time, options.output if not options.all else f"{base}_{i:06d}.png")
            say(options, i + 1, len(frames))
        return
    with tempfile.TemporaryDirectory() as folder:
        for i, (path, time) in enumerate(frames):
            draw_frame(options, deck, path, time, os.path.join(folder, f"{i:06d}.png"))
            say(options, i + 1, len(frames))
        make_film(folder, options)


def say(options, done, total):
    if total > 1 and not options.quiet and (sys.stderr.isatty() or done % 10 == 0):
        print(f"render: picture {done} of {total}", file=sys.stderr, flush=True,
              end="\r" if sys.stderr.isatty() and done < total else "\n")


def make_film(folder, options):
    command = ["ffmpeg", "-y", "-loglevel", "error", "-framerate", f"{options.rate:g}",
               "-i", os.path.join(folder, "%06d.png"), "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2",
               "-c:v", "libx264", "-pix_fmt", "yuv420p", options.output]
    result = subprocess.run(command, check=False, capture_output=True, text=True)
    if result.returncode != 0:
        raise Mistake(f"ffmpeg could not write {options.output}: {result.stderr.strip()}")


def range_of_all(frames, options):
    """One range for all frames: colours of a film must not change their meaning."""
    ranges = []
    for path, _ in frames:
        values, _ = colour_values(read_frame(path), options.field, options.component, options.invariant)
        ranges.append(colour_range(numbers(values), None))
    return min(low for low, _ in ranges), max(high for _, high in ranges)


def numbers(values):
    """Without those of particles whose material has no such field."""
    return [x for x in map(values.GetValue, range(values.GetNumberOfTuples())) if not math.isnan(x)]


def draw_frame(options, deck, path, time, output):
    data = read_frame(path)
    values, label = colour_values(data, options.field, options.component, options.invariant)
    known = numbers(values)
    low, high = colour_range(known, options.range)
    function = colour_function(low, high)
    scene = Scene(deck, data, options.crop, options.view, options.exaggeration)

    renderer, overlay = vtk.vtkRenderer(), vtk.vtkRenderer()
    layout, pixels_per_metre = place(scene, renderer, options.width)
    for actor in particle_actors(scene, data, values, function, pixels_per_metre):
        renderer.AddActor(actor)
    if options.colliders:
        for actor in collider_actors(scene, deck, options.colliders, time, options.collider_opacity):
            renderer.AddActor(actor)
    if not scene.flat:
        renderer.AddActor(box_edges(scene))
        for actor in () if options.no_faces else face_actors(scene, deck):
            renderer.AddActor(actor)
    renderer.ResetCameraClippingRange()
    window = open_window(layout, renderer, overlay)

    paper = Paper(overlay, layout.scale)
    if scene.flat:
        if not options.no_faces:
            add_flat_faces(paper, layout, scene, deck)
        add_flat_axes(paper, layout, scene)
    else:
        add_space_axes(paper, layout, scene, renderer)
    extremes = (min(known), max(known)) if known else (low, high)
    notes = ["grey: no value"] if len(known) < values.GetNumberOfTuples() else []
    add_colour_bar(paper, layout.bar(), function, (low, high), extremes, label, notes)
    title = options.title
    if title is None:
        title = deck.get("title", "") or os.path.basename(os.path.abspath(options.run))
    if options.exaggeration != 1:
        title += f" (heights x {options.exaggeration:g})"
    s = layout.scale
    paper.text(44 * s, layout.height - 32 * s, title, size=30, valign="top", bold=True)
    paper.text(layout.width - 44 * s, layout.height - 34 * s, f"t = {time:.6g} s", size=28, align="right", valign="top")
    window.Render()
    save(window, output)


def place(scene, renderer, width):
    """Sets the camera and its part of the page; returns the layout and pixels per metre."""
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    flat = scene.flat
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
