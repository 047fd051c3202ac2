"""bench.py [MODEL]: what Python adds to C, and Drypoint beside VTK's silhouettes and feature
edges, in one run.

    build/python/venv/bin/python python/bench.py stanford-bunny.obj

Frames are of 1600 x 1200 px, times the least of some frames, ms: what else the machine does shows
    least in it. Without VTK
(python3-vtk9) its rows are left out. PyVista's add_silhouette() and extract_feature_edges() are
these two of VTK's filters. --render also lets VTK draw them, which needs a display: xvfb-run.
"""

import sys
import time

import numpy as np

import drypoint

SIZE = (1600, 1200)
SMALL = (800, 600)  # of draw() unless it is told another one
FRAMES = 15


def least_ms(action):
    """The least time of an action, and what it returned last."""
    times, result = [], None
    for _ in range(FRAMES):
        start = time.perf_counter()
        result = action()
        times.append(1e3 * (time.perf_counter() - start))
    return min(times), result


def mesh(path):
    """(vertices, triangles) of an OBJ, or of a ball of 70,000 triangles."""
    if path:
        vertices, faces = [], []
        with open(path, encoding="ascii") as file:
            for line in file:
                words = line.split()
                if words[:1] == ["v"]:
                    vertices.append([float(x) for x in words[1:4]])
                elif words[:1] == ["f"]:
                    faces.append([int(word.split("/")[0]) - 1 for word in words[1:4]])
        return np.array(vertices), np.array(faces)
    t, p = np.meshgrid(np.linspace(0, np.pi, 133), np.linspace(0, 2 * np.pi, 265), indexing="ij")
    radius = 1 + 0.1 * np.sin(9 * t) * np.sin(8 * p)
    points = radius[..., None] * np.stack(
        [np.sin(t) * np.cos(p), np.cos(t), -np.sin(t) * np.sin(p)], -1
    )
    i = (np.arange(132)[:, None] * 265 + np.arange(264)).reshape(-1)
    return points.reshape(-1, 3), np.concatenate(
        [np.stack([i, i + 265, i + 266], 1), np.stack([i, i + 266, i + 1], 1)]
    )


def overhead(source, camera):
    """What a frame takes beyond dp_draw's own time, by two ways to the memory."""
    context, image = drypoint.Context(), None

    def beyond(reuse):
        nonlocal image
        times, inside = [], []
        for _ in range(2 * FRAMES):
            start = time.perf_counter()
            image = context.draw(source, camera=camera, size=SIZE, out=image if reuse else None)
            wall = 1e3 * (time.perf_counter() - start)
            inside.append(image.stats.frame_ms)
            times.append(wall - inside[-1])
        return min(inside), min(times)

    for reuse, words in ((True, "image drawn into again"), (False, "a new image each time")):
        frame, more = beyond(reuse)
        print(f"{'C, ' + words:52}{frame:9.2f} ms\n{'    and Python beyond it':52}{more:9.3f} ms")


def vtk_parts(vertices, faces):
    """(polydata, camera) as VTK has them; ImportError without. Cameras must be made after their
    back end was imported."""
    import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
    from vtkmodules.vtkRenderingCore import vtkCamera

    points, cells, data, camera = vtkPoints(), vtkCellArray(), vtkPolyData(), vtkCamera()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(vertices, np.float32), deep=True))
    runs = np.column_stack([np.full(len(faces), 3), faces]).astype(np.int64).reshape(-1)
    cells.SetCells(len(faces), numpy_to_vtkIdTypeArray(runs, deep=True))
    data.SetPoints(points)
    data.SetPolys(cells)
    middle = (vertices.min(0) + vertices.max(0)) / 2
    camera.SetFocalPoint(*middle)
    camera.SetPosition(*(middle + 2 * np.ptp(vertices) * np.array((1, 0.6, 1))))
    return data, camera


def vtk_lines(data, camera):
    """Silhouette, and edges that bend by more than 30 degrees or are borders: lines in space,
    hidden ones too."""
    from vtkmodules.vtkFiltersCore import vtkFeatureEdges
    from vtkmodules.vtkFiltersHybrid import vtkPolyDataSilhouette

    outline, edges = vtkPolyDataSilhouette(), vtkFeatureEdges()
    outline.SetInputData(data)
    outline.SetCamera(camera)
    outline.SetEnableFeatureAngle(0)
    edges.SetInputData(data)
    edges.SetFeatureAngle(30)
    edges.ManifoldEdgesOff()
    edges.NonManifoldEdgesOff()
    outline.Update()
    edges.Update()
    return outline, edges


def vtk_picture(data, camera, size):
    """The same rendered over the surface, off the screen, as an array."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkRenderingCore import (
        vtkActor,
        vtkPolyDataMapper,
        vtkRenderer,
        vtkRenderWindow,
        vtkWindowToImageFilter,
    )

    window, renderer = vtkRenderWindow(), vtkRenderer()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(4)
    window.SetSize(*size)
    window.AddRenderer(renderer)
    renderer.SetBackground(1, 1, 1)
    renderer.SetActiveCamera(camera)
    for part in (data, *vtk_lines(data, camera)):
        mapper, actor = vtkPolyDataMapper(), vtkActor()
        if part is data:
            mapper.SetInputData(data)
        else:
            mapper.SetInputData(part.GetOutput())
            actor.GetProperty().SetColor(0, 0, 0)
            actor.GetProperty().SetLineWidth(2)
        mapper.ScalarVisibilityOff()
        actor.SetMapper(mapper)
        renderer.AddActor(actor)
    renderer.ResetCamera()
    window.Render()
    grab = vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.Update()
    return vtk_to_numpy(grab.GetOutput().GetPointData().GetScalars())


def beside_vtk(vertices, faces, display):
    """One call of each, from arrays to lines, and to a picture."""
    for size in (SIZE, SMALL):
        ours, image = least_ms(lambda: drypoint.draw(vertices, faces, size=size))
        words = f"drypoint.draw(vertices, faces), {size[0]} x {size[1]} px"
        print(f"{words:52}{ours:9.2f} ms   {len(image.segments())} visible segments")
    try:
        data, camera = vtk_parts(vertices, faces)
    except ImportError as error:
        print(f"VTK is left out: {error}")
        return
    theirs, found = least_ms(lambda: vtk_lines(data, camera))
    lines = sum(part.GetOutput().GetNumberOfLines() for part in found)
    print(
        f"{'VTK: silhouette + feature edges, not rendered':52}{theirs:9.2f} ms   "
        f"{theirs / ours:.1f} x   {lines} lines, hidden ones too"
    )
    if display:
        theirs, _ = least_ms(lambda: vtk_picture(data, camera, SMALL))
        print(f"{'VTK: the same rendered':52}{theirs:9.2f} ms   {theirs / ours:.1f} x")


def main(path, display):
    vertices, faces = mesh(path)
    print(
        f"{path or 'a ball with bumps'}: {len(faces)} triangles, {SIZE[0]} x {SIZE[1]} px, "
        f"drypoint {drypoint.__version__}"
    )
    source = drypoint.Source.from_arrays(vertices.astype(np.float32), faces.astype(np.uint32))
    overhead(source, drypoint.Camera.fit().resolve(source, SIZE))
    beside_vtk(vertices, faces, display)


if __name__ == "__main__":
    names = [argument for argument in sys.argv[1:] if argument != "--render"]
    main(names[0] if names else None, "--render" in sys.argv)
