"""Meshes in every form that people have, good and bad."""

import unittest

import numpy as np

import drypoint
from models import CUBE, QUADS, TRIANGLES, Open3D, PyVista, Regular, Trimesh

SIZE = (120, 90)


def draw(*arguments, **named):
    named.setdefault("size", SIZE)
    return drypoint.draw(*arguments, **named)


def pixels(*arguments, **named):
    return draw(*arguments, **named).rgba


class Forms(unittest.TestCase):
    """The same picture, whatever the arrays' type and layout."""

    @classmethod
    def setUpClass(cls):
        cls.expected = pixels(CUBE, QUADS)
        assert len(np.unique(cls.expected)) > 2

    def same(self, *arguments, **named):
        np.testing.assert_array_equal(pixels(*arguments, **named), self.expected)

    def test_types_of_vertices(self):
        for kind in ("f2", "f4", ">f4", "f8", ">f8", "g", "i1", "u2", "i4", ">i8"):
            with self.subTest(kind):
                self.same(CUBE.astype(kind), QUADS)

    def test_types_of_faces(self):
        for kind in ("u1", "i2", ">u2", "i4", ">i4", "u4", "i8", "u8"):
            with self.subTest(kind):
                self.same(CUBE, QUADS.astype(kind))

    def test_lists_and_tuples(self):
        self.same(CUBE.tolist(), QUADS.tolist())
        self.same(tuple(map(tuple, CUBE)), [tuple(face) for face in QUADS])

    def test_mixed_polygons(self):
        faces = [*QUADS[:5], *QUADS[5][[[0, 1, 2], [0, 2, 3]]]]
        image = draw(CUBE, faces)
        self.assertEqual(image.stats.polygons, 7)
        self.assertLess(np.count_nonzero(image.rgba != self.expected), 20)

    def test_layouts(self):
        wide = np.zeros((8, 5), np.float32)
        wide[:, 1:4] = CUBE
        packed = np.zeros(8 * 13, np.uint8)  # rows of 13 bytes: floats that are not aligned
        odd = np.ndarray((8, 3), np.float32, packed, 0, (13, 4))
        odd[:] = CUBE
        for vertices in (
            wide[:, 1:4],
            odd,
            np.asfortranarray(CUBE),
            CUBE[::-1][::-1],
            np.repeat(CUBE, 2, 0)[::2],
        ):
            self.same(vertices, QUADS)
        self.same(CUBE, np.asfortranarray(QUADS))
        self.same(CUBE, np.repeat(QUADS.astype(np.uint32), 2, 0)[::2])
        self.same(CUBE[::-1], 7 - QUADS)

    def test_read_only_and_untouched(self):
        vertices, faces = CUBE.astype(np.float32), QUADS.astype(np.uint32)
        vertices.flags.writeable = faces.flags.writeable = False
        self.same(vertices, faces)
        np.testing.assert_array_equal(vertices, CUBE)

    def test_not_copied(self):
        vertices, faces = CUBE.astype(np.float32), QUADS.astype(np.int32)
        source = drypoint.Source.from_arrays(vertices, faces)
        kept = [array for array in source._keep if isinstance(array, np.ndarray)]
        for array in (vertices, faces):
            self.assertTrue(any(np.shares_memory(array, other) for other in kept))
        before = drypoint.draw(source, size=SIZE).rgba.copy()
        vertices[:, 0] *= 2  # positions may change between drawings
        self.assertTrue((drypoint.draw(source, size=SIZE).rgba != before).any())

    def test_soups(self):
        np.testing.assert_array_equal(
            pixels(CUBE[TRIANGLES].reshape(-1, 3)), pixels(CUBE[TRIANGLES])
        )
        self.assertEqual(draw(CUBE[QUADS]).stats.polygons, 6)

    def test_mesh_objects(self):
        triangles = pixels(CUBE, TRIANGLES)
        for mesh in (Trimesh, Trimesh()):
            np.testing.assert_array_equal(pixels(mesh), triangles)
        np.testing.assert_array_equal(pixels(Open3D()), triangles)
        self.same(PyVista())
        self.same(Regular())

    def test_mixed_counts(self):
        mesh = PyVista()
        mesh.faces = np.array([4, *QUADS[0], 3, 0, 1, 2, 5, 0, 1, 2, 3, 4])
        self.assertEqual(draw(mesh).stats.polygons, 3)

    def test_open3d_itself(self):
        try:
            import open3d
        except ImportError:
            self.skipTest("there is no open3d")
        mesh = open3d.geometry.TriangleMesh.create_box()
        mesh.paint_uniform_color((1, 0, 0))
        style = drypoint.Style(shade={"model_colors": True}, lines="none")
        self.assertEqual(draw(mesh, style=style).rgba[45, 60].tolist(), [255, 0, 0, 255])

    def test_far_from_zero(self):
        far = np.array((500000.25, 5400000.5, 100.0))
        image = draw(CUBE + far, QUADS)
        np.testing.assert_array_equal(image.rgba, self.expected)
        world = image.segments()["world_a"]
        np.testing.assert_allclose((world - far).max(axis=0), 1, atol=1e-4)

    def test_attributes(self):
        lit = drypoint.Style(shade=drypoint.Shade(model_colors=True), lines="none")
        floats, whole = np.tile((1.0, 0.5, 0.0), (8, 1)), np.full((8, 4), (255, 128, 0, 255))
        packed = np.full(8, 0xFF8000FF, np.int64)
        for colors in (floats, whole, packed):
            self.assertEqual(
                pixels(CUBE, QUADS, colors=colors, style=lit)[45, 60].tolist(), [255, 128, 0, 255]
            )
        image = draw(CUBE, QUADS, groups=range(6), planes=["id"])
        self.assertEqual(set(np.unique(image.id)), {0, 3 + 1, 5 + 1, 1 + 1})
        for count in (8, 24):  # for each vertex, for each corner
            normals = np.tile((0.0, 1.0, 0.0), (count, 1))
            toon = pixels(CUBE, QUADS, normals=normals, style={"shade": {"shading": "lambert"}})
            self.assertTrue((toon != self.expected).any())
        hidden = draw(CUBE, QUADS, edges=["never"] * 24)
        self.assertEqual(len(hidden.segments()), 0)


class Mistakes(unittest.TestCase):
    """A clear exception for each, and never a crash."""

    def refuse(self, words, *arguments, kind=drypoint.ArgumentError, **named):
        with self.assertRaisesRegex(kind, words):
            draw(*arguments, **named)

    def test_shapes(self):
        self.refuse(r"shape \(8, 2\)", CUBE[:, :2], QUADS)
        self.refuse(r"shape \(24,\)", CUBE.reshape(-1), QUADS)
        self.refuse(r"\(2, 4, 3\)", CUBE.reshape(2, 4, 3), QUADS)
        self.refuse("counts", CUBE, QUADS.reshape(-1))
        self.refuse("2 corners", CUBE, QUADS[:, :2])
        self.refuse("no whole number of triangles", CUBE)
        self.refuse("vertices", [[0, 0, 0], [1, 0]], QUADS)
        self.refuse("no real numbers", "no such thing".split(), QUADS)
        self.refuse("no real numbers", CUBE.astype(complex), QUADS)
        self.refuse("no real numbers", CUBE > 0, QUADS)
        self.refuse("", object())
        self.refuse("", None, None)
        self.assertIsInstance(drypoint.ArgumentError("x"), ValueError)

    def test_vertex_numbers(self):
        for number in (8, -1, 2**31, 2**32, 2**40, -(2**40)):
            faces = QUADS.astype(np.int64)
            faces[4, 2] = number
            self.refuse(rf"{number} \(in face 4\)", CUBE, faces)
            image = draw(CUBE, faces, check=False)
            self.assertEqual(image.stats.dropped_index, 1)
        self.refuse("no whole numbers", CUBE, QUADS.astype(float))
        self.refuse("-1", CUBE, [(0, 1, 2), (0, 1, 2, -1)])

    def test_not_finite(self):
        for value in (np.nan, np.inf, -np.inf, 1e300):
            vertices = CUBE.copy()
            vertices[7, 1] = value
            self.refuse("vertex 7", vertices, QUADS)
            self.assertEqual(draw(vertices, QUADS, check=False).stats.dropped_finite, 3)
        unused = np.vstack([CUBE, [[np.nan] * 3]])
        self.assertEqual(draw(unused, QUADS).stats.dropped, 0)
        with self.assertRaises(drypoint.Error):
            draw(np.full((8, 3), np.nan), QUADS, check=False)

    def test_empty(self):
        for vertices, faces in (
            ([], []),
            (CUBE, []),
            (CUBE, np.empty((0, 3), int)),
            ([], None),
            ([], QUADS),
        ):
            self.refuse("", vertices, faces)
        self.refuse("no polygons", np.empty((0, 3)))
        with self.assertRaises(drypoint.FormatError):  # the only polygon has no area
            draw(CUBE[:1].astype(np.float32)[::-1], [(0, 0, 0)])

    def test_attributes(self):
        for name, value in (
            ("groups", [0] * 5),
            ("groups", [-1] * 6),
            ("groups", [70000] * 6),
            ("groups", [0.5] * 6),
            ("colors", np.ones((7, 3))),
            ("colors", np.full((8, 3), 300)),
            ("colors", np.full((8, 3), 1.5)),
            ("normals", np.ones((7, 3))),
            ("texcoords", np.ones((8, 3))),
            ("edges", [1] * 23),
            ("edges", ["fold"] * 24),
        ):
            with self.subTest(name):
                self.refuse(name, CUBE, QUADS, **{name: value})

    def test_objects(self):
        class Cells:
            points, cells = CUBE, ()

        class Broken(PyVista):
            faces = np.array([4, 0, 1, 2])

        self.refuse("extract_surface", Cells())
        self.refuse("faces with counts", Broken())

    def test_pictures(self):
        for size in ((0, 10), (-5, 10), ("a", 1), 7, (1, 2, 3), (2**40, 1), (1.5, 2)):
            self.refuse("size", CUBE, QUADS, size=size)
        for size in ((10**6, 10**6), (40000, 1)):
            self.refuse("", CUBE, QUADS, size=size)
        self.refuse("", CUBE, QUADS, samples=3)
        self.refuse("", CUBE, QUADS, samples=-1)
        self.refuse("did you mean 'depth'", CUBE, QUADS, planes=["dept"])
        self.refuse("own faces", drypoint.Source.shape("cube"), QUADS)


if __name__ == "__main__":
    unittest.main()
