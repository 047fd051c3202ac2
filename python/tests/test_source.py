"""Where polygons come from."""

import os
import pathlib
import struct
import tempfile
import unittest

import numpy as np

import drypoint
from models import CUBE, QUADS, TRIANGLES, sphere

OBJ = "".join(f"v {x} {y} {z}\n" for x, y, z in CUBE) + "".join(
    "f " + " ".join(str(i + 1) for i in face) + "\n" for face in QUADS
)
COLORED = "mtllib a.mtl\ng lid\nusemtl m\n" + OBJ
MTL = b"newmtl m\nKd 1 0 0\n"
STL = (
    b"\0" * 80
    + struct.pack("<I", 12)
    + b"".join(struct.pack("<12fH", 0, 0, 0, *CUBE[face].reshape(-1), 0) for face in TRIANGLES)
)


def draw(source, **named):
    return drypoint.draw(source, size=(100, 80), **named)


class Files(unittest.TestCase):
    """On disk and in memory."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_open(self):
        path = self.folder / "würfel.obj"
        path.write_text(OBJ)
        expected = draw(drypoint.Source.from_arrays(CUBE, QUADS)).rgba
        for name in (path, str(path)):
            np.testing.assert_array_equal(draw(drypoint.Source.open(name)).rgba, expected)
        np.testing.assert_array_equal(draw(path).rgba, expected)
        with self.assertRaisesRegex(drypoint.FormatError, ""):
            drypoint.Source.open(path, format="stl").extent

    def test_errors(self):
        bad = self.folder / "bad.obj"
        bad.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 x\n")
        with self.assertRaisesRegex(drypoint.FormatError, "bad.obj: ") as caught:
            drypoint.Source.open(bad)
        self.assertEqual(caught.exception.line, 4)
        with self.assertRaisesRegex(OSError, "No such file"):
            drypoint.Source.open(self.folder / "none.obj")
        with self.assertRaises(drypoint.Error):
            drypoint.Source.open(self.folder)
        with self.assertRaises(drypoint.FileError):
            drypoint.Source.open("-")  # a file of that name, not standard input
        with self.assertRaises(TypeError):
            drypoint.Source.open(7)
        with self.assertRaises(drypoint.ArgumentError):
            drypoint.Source.open(f"{bad}\0.stl")
        (self.folder / "a.xyz").write_text("what is this")
        with self.assertRaises(drypoint.Error):
            drypoint.Source.open(self.folder / "a.xyz")

    def test_assimp(self):
        if not drypoint.has_io:
            self.skipTest("there is no Assimp")
        path = self.folder / "cube.dae"
        path.write_text(DAE)
        self.assertEqual(draw(path).stats.triangles, 1)

    def test_bytes(self):
        for data in (STL, bytearray(STL), memoryview(STL), np.frombuffer(STL, np.uint8)):
            source = drypoint.Source.from_bytes(data)
            del data
            self.assertEqual([draw(source).stats.triangles for _ in range(2)], [12, 12])
        for wrong in ("text", 7, None):
            with self.assertRaises(drypoint.ArgumentError):
                drypoint.Source.from_bytes(wrong)
        for data in (b"", b"\0", STL[:100], b"solid\nfacet"):
            with self.assertRaises(drypoint.Error):
                draw(drypoint.Source.from_bytes(data, "a.stl"))
        with self.assertRaisesRegex(drypoint.FormatError, "offset 84|triangle|ends"):
            draw(drypoint.Source.from_bytes(STL[:-30], "a.stl"))

    def test_beside(self):
        asked = []
        for beside in ({"a.mtl": MTL}, lambda name: asked.append(name) or MTL):
            source = drypoint.Source.from_bytes(COLORED.encode(), "a.obj", beside=beside)
            self.assertEqual([(g.name, g.color) for g in source.groups], [("lid/m", 0xFF0000FF)])
        self.assertEqual(asked, ["a.mtl"])
        alone = drypoint.Source.from_bytes(COLORED.encode(), "a.obj", beside={})
        alone.extent
        self.assertIn("a.mtl", alone.remark)

    def test_beside_fails(self):
        def beside(name):
            raise KeyError(name)

        with self.assertRaises(KeyError):
            drypoint.Source.from_bytes(COLORED.encode(), "a.obj", beside=beside)
        with self.assertRaises(TypeError):
            drypoint.Source.from_bytes(COLORED.encode(), "a.obj", beside=lambda name: 7)


class Models(unittest.TestCase):
    """What sources know and become."""

    def test_shapes(self):
        self.assertGreater(len(drypoint.shapes()), 10)
        self.assertGreater(drypoint.Source.shape("torus", triangles=5000).extent.polygons, 4000)
        for wrong in ({"size": "x"}, {"triangles": -1}, {"seed": 2**40}):
            with self.assertRaises(drypoint.ArgumentError):
                drypoint.Source.shape("torus", **wrong)

    def test_extent(self):
        extent = drypoint.Source.from_arrays(CUBE, QUADS).extent
        self.assertEqual(
            (extent.exact_min, extent.exact_max, extent.polygons), ((0, 0, 0), (1, 1, 1), 6)
        )
        self.assertEqual(drypoint.Source.shape("cube").up.tolist(), [0, 1, 0])

    def test_groups(self):
        groups = drypoint.Source.from_arrays(CUBE, QUADS, groups=[0, 0, 0, 200, 200, 200]).groups
        self.assertEqual([(g.number, g.polygons) for g in groups], [(0, 3), (200, 3)])
        self.assertEqual(groups[0].max, (1, 1, 1))

    def test_join(self):
        parts = [
            drypoint.Source.from_arrays(CUBE, QUADS),
            drypoint.Source.from_arrays(CUBE + 2, QUADS),
        ]
        scene = drypoint.Source.join(parts, ["low", "high"])
        self.assertEqual([g.name for g in scene.groups], ["low", "high"])
        with self.assertRaisesRegex(drypoint.ArgumentError, "belongs to another"):
            draw(parts[0])
        del parts
        self.assertEqual(draw(scene).stats.polygons, 12)
        one = drypoint.Source.shape("cube")
        for wrong in ([], [one, one]):
            with self.assertRaises(drypoint.ArgumentError):
                drypoint.Source.join(wrong)
        self.assertEqual(draw(one).stats.polygons, 12)  # still whole
        with self.assertRaises(drypoint.ArgumentError):
            drypoint.Source.join([one], ["a", "b"])

    def test_clip(self):
        source = drypoint.Source.from_arrays(CUBE, QUADS).clip(
            [((1, 0, 0), 0.5), drypoint.ClipPlane((0, 1, 0), 0.25)]
        )
        self.assertEqual(source.extent.exact_max, (0.5, 0.25, 1))
        self.assertIn(drypoint.Line.SECTION, draw(source).segments()["line"])
        clip = drypoint.Clip(planes=[drypoint.ClipPlane((0, 0, 1), 0.5)], look="plain")
        self.assertNotIn(
            drypoint.Line.HATCHING,
            draw(drypoint.Source.shape("cube").clip(clip)).segments()["line"],
        )
        for wrong in (
            drypoint.Clip(planes=[3]),
            [((0, 0, 0), 1.0)],
            [((1, 0, 0), 0.0)] * 9,
            [3],
            [((1, 0), 0.0)],
        ):
            with self.assertRaises((drypoint.ArgumentError, TypeError)):
                drypoint.Source.shape("cube").clip(wrong)

    def test_time(self):
        source = drypoint.Source.shape("flag").deform(kind="wave", amplitude=0.2)
        pictures = []
        for source.time in (0, 0.3, 0):
            pictures.append(draw(source).rgba.tobytes())
        self.assertEqual(source.time, 0)
        self.assertTrue(pictures[0] == pictures[2] != pictures[1])
        with self.assertRaises(drypoint.ArgumentError):
            source.time = float("nan")
        with self.assertRaises(drypoint.ArgumentError):
            drypoint.Source.shape("flag").deform(kind="wav")
        self.assertEqual(source.clips, [])
        with self.assertRaises(drypoint.ArgumentError):
            source.play(0)

    def test_arrays_outlive_their_names(self):
        sources = []
        for _ in range(20):
            vertices, faces = sphere()
            sources.append(drypoint.Source.from_arrays(vertices, faces))
            del vertices, faces
        junk = [np.full(10000, np.nan) for _ in range(50)]
        self.assertEqual(len({draw(source).rgba.tobytes() for source in sources}), 1)
        del junk


DAE = """<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<library_geometries><geometry id="g"><mesh><source id="p"><float_array id="a" count="9">0 0 0 1 0 0 0 1 0</float_array>
<technique_common><accessor source="#a" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/>
</vertices><triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles></mesh></geometry>
</library_geometries><library_visual_scenes><visual_scene id="s"><node><instance_geometry url="#g"/></node></visual_scene>
</library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>"""

if __name__ == "__main__":
    unittest.main()
