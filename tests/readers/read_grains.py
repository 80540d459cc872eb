"""Opens a collection of grains as ParaView does and looks at what it holds."""

import sys

import numpy
import pyvista

reader = pyvista.get_reader(f"{sys.argv[1]}/grains.pvd")
times = reader.time_values
assert len(times) == 11 and times[0] == 0.0, times
heights = []
for time in times:
    reader.set_active_time_value(time)
    grains = reader.read()[0]
    assert grains.n_points == 64 and grains.n_verts == 64
    assert set(grains.point_data) == {
        "grain", "class", "radius", "diameter", "velocity", "speed", "coordination",
    }, list(grains.point_data)
    assert list(grains["grain"]) == list(range(64))
    assert grains["velocity"].shape == (64, 3)
    assert numpy.allclose(numpy.linalg.norm(grains["velocity"], axis=1), grains["speed"])
    assert numpy.all(grains["diameter"] == 2 * grains["radius"])
    heights.append(grains.points[:, 2].mean())
assert all(later <= earlier for earlier, later in zip(heights, heights[1:])), heights
assert heights[-1] < heights[0]
print(f"{len(times)} times of {grains.n_points} grains")
