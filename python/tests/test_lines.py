"""Images, their planes, their lines, and files of them."""

import json
import os
import pathlib
import struct
import tempfile
import unittest
import xml.etree.ElementTree as xml
import zlib

import numpy as np

import drypoint
from drypoint._library import ffi


def bolt(**named):
    return drypoint.draw(drypoint.Source.shape("bolt"), size=(200, 150), **named)


def decoded(png):
    """Pixels of a PNG that drypoint wrote."""
    width, height, depth, kind = struct.unpack(">IIBB", png[16:26])
    place, data = 8, b""
    while place < len(png):
        size, name = struct.unpack(">I4s", png[place : place + 8])
        chunk = png[place + 8 : place + 8 + size]
        assert struct.unpack(">I", png[place + 8 + size : place + 12 + size])[0] == zlib.crc32(
            name + chunk
        )
        data += chunk if name == b"IDAT" else b""
        place += 12 + size
    channels = {2: 3, 6: 4}[kind]
    rows = np.frombuffer(zlib.decompress(data), np.uint8).reshape(height, 1 + channels * width)
    assert depth == 8 and not rows[:, 0].any()
    return rows[:, 1:].reshape(height, width, channels)


class Planes(unittest.TestCase):
    """What an image holds."""

    def test_all(self):
        names = ["depth", "normals", "classes", "id", "edge_map", "eye_normals", "distance"]
        image = bolt(planes=names, style={"edge_map": {"detector": "diagonal"}})
        shapes = [
            (150, 200),
            (150, 200, 3),
            (150, 200),
            (150, 200),
            (150, 200, 4),
            (150, 200, 3),
            (150, 200),
        ]
        self.assertEqual([getattr(image, name).shape for name in names], shapes)
        seen = image.id > 0
        self.assertTrue(0.02 < seen.mean() < 0.9)
        self.assertTrue(
            np.isfinite(image.distance[seen]).all() and np.isinf(image.distance[~seen]).all()
        )
        np.testing.assert_allclose(np.linalg.norm(image.eye_normals[seen], axis=-1), 1, atol=1e-3)
        self.assertEqual(set(np.unique(image.classes)) - set(range(6)), set())
        self.assertIsNone(bolt().depth)

    def test_arrays(self):
        image = bolt()
        self.assertEqual((np.asarray(image).shape, image.size), ((150, 200, 4), (200, 150)))
        self.assertTrue(np.shares_memory(np.asarray(image), image.rgba))
        self.assertEqual(np.array(image, dtype=np.float32).dtype, np.float32)

    def test_memory_is_used_again(self):
        source, context = drypoint.Source.shape("bolt"), drypoint.Context()
        image = context.draw(source, size=(200, 150), planes=["depth"])
        memory, lines = image.rgba, image.segments()
        again = context.draw(source, out=image, camera=drypoint.Camera.fit(direction=(0, 1, 0)))
        self.assertIs(again, image)
        self.assertIs(again.rgba, memory)
        self.assertNotEqual(len(again.segments()), len(lines))

    def test_stats(self):
        stats = bolt().stats
        self.assertTrue(
            stats.triangles > 1000
            and stats.frame_ms > 0
            and len(stats.stage_ms) == len(drypoint.Stage)
        )


class Lines(unittest.TestCase):
    """Segments, chains, paths."""

    def test_layout(self):
        for dtype, name in ((drypoint.SEGMENT, "dp_segment"), (drypoint.POINT, "dp_path_point")):
            self.assertEqual(dtype.itemsize, ffi.sizeof(name))
            self.assertEqual(list(dtype.names), [key for key, _ in ffi.typeof(name).fields])

    def test_segments(self):
        segments = bolt().segments()
        self.assertGreater(len(segments), 100)
        self.assertEqual(segments.dtype, drypoint.SEGMENT)
        self.assertTrue((segments["a"][:, 0] >= -1).all() and (segments["b"][:, 0] <= 201).all())
        self.assertEqual(set(segments["line"]) - {0, 1, 2, 3, 4}, set())
        segments["width"] = 0  # a copy: the library's own are not touched

    def test_chains(self):
        image = bolt()
        segments, (lines, points) = image.segments(), image.chains()
        self.assertEqual(len(lines), segments["chain"].max() + 1)
        self.assertEqual(len(points), len(segments) + len(lines))
        self.assertEqual(lines["count"].sum(), len(points))
        long = 0.0
        for _, chain in image.chains().each():
            steps = np.hypot(np.diff(chain["x"]), np.diff(chain["y"]))
            long += steps.sum()
        each = np.hypot(*(segments["a"] - segments["b"])[:, :2].T).sum()
        self.assertAlmostEqual(long / each, 1, places=3)
        self.assertGreater(lines["closed"].sum(), 0)

    def test_no_lines(self):
        image = bolt(style={"lines": "none"})
        self.assertEqual(
            (len(image.segments()), len(image.chains().lines), len(image.drawing().paths().lines)),
            (0, 0, 0),
        )
        xml.fromstring(image.svg())

    def test_paths(self):
        drawing = bolt().drawing()
        paths, points = drawing.paths()
        self.assertEqual((len(paths), len(points)), (drawing.info.paths, drawing.info.points))
        self.assertEqual(paths["count"].sum(), len(points))
        self.assertGreater(points["x"].max(), points["x"].min() + 30)

    def test_images_keep_their_lines(self):
        directions = [(1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1), (1, 2, 3)]
        images = [bolt(camera=drypoint.Camera.fit(direction=d)) for d in directions]
        for image, direction in zip(images, directions):
            alone = bolt(
                camera=drypoint.Camera.fit(direction=direction), context=drypoint.Context(threads=1)
            )
            np.testing.assert_array_equal(image.segments()["world_a"], alone.segments()["world_a"])
            self.assertEqual(image.svg(), alone.svg())
        self.assertEqual(
            images[-1].drawing(optimize=True).info.paths, images[-1].drawing().info.paths
        )
        with self.assertRaisesRegex(drypoint.Error, "drawn others"):
            images[0].drawing(optimize=True)

    def test_hidden(self):
        segments = bolt(style={"hidden": {"look": "dashed", "levels": 3}}).segments()
        self.assertEqual(segments["level"].max(), 3)


class Files(unittest.TestCase):
    """SVG, PDF, EPS, DXF, JSON, PNG."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_formats(self):
        image = bolt()
        paths = image.drawing().info.paths
        svg = xml.fromstring(image.svg(title="a <bolt>"))
        self.assertEqual(len(svg.findall(".//{*}path")), paths)
        self.assertTrue(image.pdf().startswith(b"%PDF") and b"FlateDecode" in image.pdf())
        self.assertLess(len(image.pdf()), len(image.eps()))
        self.assertIn(b"%!PS", image.eps())
        self.assertIn(b"EOF", image.dxf())
        self.assertEqual(len(json.loads(image.json())["views"][0]["paths"]), paths)
        self.assertEqual(image.drawing()._repr_svg_(), image.svg())

    def test_pdf_holds_what_svg_does(self):
        pdf = bolt().pdf()
        streams = [
            zlib.decompress(part.split(b"endstream")[0].strip(b"\r\n"))
            for part in pdf.split(b"stream\n")[1::2]
            if part[:1] == b"\x78"
        ]
        self.assertTrue(
            any(stream.count(b" l\n") + stream.count(b" l ") > 50 for stream in streams),
            [s[:60] for s in streams],
        )

    def test_grounds(self):
        lines = bolt(style={"shade": {"shading": "gooch"}})
        ground = bolt(style={"shade": {"shading": "gooch"}, "lines": "none"})
        self.assertIn("data:image/png", lines.svg(ground=ground))
        with self.assertRaisesRegex(drypoint.ArgumentError, "ground"):
            lines.svg(ground=np.zeros((2, 2, 4), np.uint8))

    def test_pages(self):
        svg = xml.fromstring(bolt().svg(mm_per_px=0.5, paper="ivory"))
        self.assertEqual((svg.get("width"), svg.get("height")), ("100mm", "75mm"))
        for wrong in ({"mm_per_px": -1}, {"mm_per_px": float("nan")}, {"paper": "ivry"}):
            with self.assertRaises(drypoint.ArgumentError):
                bolt().svg(**wrong)
        with self.assertRaises(TypeError):
            bolt().svg(colour="red")

    def test_png(self):
        image = bolt()
        np.testing.assert_array_equal(decoded(image._repr_png_()), image.rgba[..., :3])
        glass = bolt(style={"paper": (1.0, 1, 1, 0.5)})
        np.testing.assert_array_equal(decoded(glass.png()), glass.rgba)
        self.assertIn(b"pHYs", image.png(dpi=300))

    def test_save(self):
        image = bolt()
        for name in ("a.png", "a.svg", "a.PDF", "a.eps", "a.dxf", "a.json"):
            image.save(self.folder / name)
            self.assertGreater((self.folder / name).stat().st_size, 500)
        self.assertEqual((self.folder / "a.svg").read_text(), image.svg())
        image.drawing().save(self.folder / "b", "svg")
        self.assertEqual((self.folder / "b").read_text(), image.svg())
        for name, near in (("a.svgz", "svg"), ("a", "known"), ("a.jpg", "")):
            with self.assertRaisesRegex(drypoint.ArgumentError, near):
                image.save(self.folder / name)

    def test_whole_or_not_at_all(self):
        path = self.folder / "old.svg"
        path.write_text("old")
        path.chmod(0o640)
        with self.assertRaises(drypoint.ArgumentError):
            bolt().save(path, mm_per_px=-1)
        self.assertEqual(path.read_text(), "old")
        link = self.folder / "link.svg"
        link.symlink_to(path)
        bolt().save(link)
        self.assertTrue(link.is_symlink() and path.read_text().startswith("<?xml"))
        self.assertEqual(path.stat().st_mode & 0o777, 0o640)
        self.assertEqual(sorted(os.listdir(self.folder)), ["link.svg", "old.svg"])
        with self.assertRaisesRegex(OSError, "cannot be written"):
            bolt().save(self.folder / "none" / "a.svg")


if __name__ == "__main__":
    unittest.main()
