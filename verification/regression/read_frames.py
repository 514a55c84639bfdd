# SPDX-License-Identifier: Apache-2.0
"""Reads the frames of two runs of one deck, the one as .vtu files and the other as XDMF, with meshio; both must hold the same.

usage: read_frames.py VTU_RUN XDMF_RUN
"""

import os
import sys
import xml.etree.ElementTree as ElementTree

import meshio
import numpy


def vtu_frames(run):
    for item in ElementTree.parse(os.path.join(run, "particles.pvd")).getroot().iter("DataSet"):
        mesh = meshio.read(os.path.join(run, item.get("file")))
        yield float(item.get("timestep")), mesh.points, mesh.point_data


def xdmf_frames(run):
    with meshio.xdmf.TimeSeriesReader(os.path.join(run, "particles.xdmf")) as series:
        points, cells = series.read_points_cells()
        assert cells[0].type == "vertex" and len(cells[0].data) == len(points)
        for frame in range(series.num_steps):
            time, data, _ = series.read_data(frame)
            yield time, data.pop("position"), data


def main():
    vtu, xdmf = list(vtu_frames(sys.argv[1])), list(xdmf_frames(sys.argv[2]))
    assert len(vtu) == len(xdmf) > 2, (len(vtu), len(xdmf))
    for (time, points, data), (other_time, other_points, other_data) in zip(vtu, xdmf):
        assert time == other_time
        assert numpy.array_equal(points, other_points)
        assert sorted(data) == sorted(other_data), (sorted(data), sorted(other_data))
        for name, values in data.items():
            flat = other_data[name].reshape(values.shape)
            assert values.dtype == flat.dtype, name
            assert numpy.array_equal(values, flat, equal_nan=values.dtype.kind == "f"), name
    print(f"{len(vtu)} frames, {len(data)} arrays")


main()
