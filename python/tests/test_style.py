"""Styles: what is made of the headers, names, colours, and how they reach C."""

import dataclasses
import enum
import inspect
import unittest

import numpy as np

import drypoint
from drypoint import _generated, _struct
from drypoint._library import ffi, lib
from drypoint._texture import filler

PICTURE = dict(size=(120, 90))


def color(value):
    return filler.new(drypoint.LineStyle(color=value), [])[0].color


class Generated(unittest.TestCase):
    """The classes are what the compiler saw."""

    structs = [
        c
        for c in vars(_generated).values()
        if inspect.isclass(c) and issubclass(c, _struct.Struct) and hasattr(c, "_c")
    ]
    enums = [
        c
        for c in vars(_generated).values()
        if inspect.isclass(c) and issubclass(c, enum.IntEnum) and len(c)
    ]

    def test_all_fields(self):
        self.assertGreater(len(self.structs), 12)
        for cls in self.structs:
            left_out = {
                "dp_clip": ["plane_count"],
                "dp_edge_map": ["enhanced_count"],
                "dp_deform": ["vertices", "user", "normals"],
            }.get(cls._c, [])
            fields = [name for name, _ in ffi.typeof(cls._c).fields if name not in left_out]
            self.assertEqual([field.name for field in dataclasses.fields(cls)], fields)

    def test_all_constants(self):
        self.assertGreater(len(self.enums), 20)
        for cls in self.enums:
            for member in cls:
                names = [
                    name
                    for name in dir(lib)
                    if name.startswith("DP_") and name.endswith("_" + member.name)
                ]
                self.assertIn(int(member), {getattr(lib, name) for name in names}, member)

    def test_zero_is_the_default(self):
        for cls in self.structs:
            made = filler.new(cls(), [])
            self.assertEqual(bytes(ffi.buffer(made)), bytes(ffi.sizeof(cls._c)), cls)

    def test_texts(self):
        self.assertIn("degrees in (0, 360); 0 means 150", drypoint.Style.__doc__)
        self.assertIn("DASHED: 12 widths drawn", drypoint.HiddenLook.__doc__)
        for cls in self.structs:
            self.assertTrue(
                all(f"        {f.name}: " in cls.__doc__ for f in dataclasses.fields(cls)), cls
            )

    def test_every_result_has_an_exception(self):
        from drypoint import _errors

        self.assertEqual(set(_errors._CLASSES), {r.name for r in _generated.Result} - {"OK"})

    def test_versions(self):
        self.assertEqual(".".join(map(str, _generated.VERSION)), drypoint.__version__)
        from drypoint._library import call

        with self.assertRaisesRegex(drypoint.UnsupportedError, "99"):
            call(lib.dp_version_check_header, 99, 0, 0)


class Values(unittest.TestCase):
    """What people write."""

    def test_colors(self):
        for value, expected in (
            ("#f00", 0xFF0000FF),
            ("#FF000080", 0xFF000080),
            ("red", 0xFF0000FF),
            ("Navy", 0x000080FF),
            ((255, 0, 0), 0xFF0000FF),
            ((1.0, 0, 0), 0xFF0000FF),
            ((0.0, 0.0, 0.0, 0.5), 0x80),
            (np.array([0, 255, 0], np.uint8), 0x00FF00FF),
            (0x12345678, 0x12345678),
            (None, 0),
            ("none", lib.DP_COLOR_NONE),
            ((0, 0, 0, 0), lib.DP_COLOR_NONE),
        ):
            self.assertEqual(color(value), expected, value)

    def test_no_colors(self):
        for value in (
            "#12",
            "#gggggg",
            "redd",
            (1, 2),
            (300, 0, 0),
            (2.0, 0, 0),
            object(),
            2**32,
            -1,
            "",
            ("a", "b", "c"),
        ):
            with self.assertRaises(drypoint.ArgumentError, msg=value):
                color(value)

    def test_lines(self):
        def bits(lines):
            return filler.new(drypoint.Style(lines=lines), [])[0].lines

        both = lib.DP_SILHOUETTE | lib.DP_RIDGE
        self.assertEqual(bits({"silhouette", "ridge"}), both)
        self.assertEqual(bits([drypoint.Line.SILHOUETTE, "Ridge"]), both)
        self.assertEqual(bits("valley"), lib.DP_VALLEY)
        self.assertEqual(bits(both), both)
        self.assertEqual([bits(None), bits("all")], [0, 0])
        self.assertEqual([bits("none"), bits(())], [lib.DP_NO_LINES] * 2)
        for wrong in ("sillhouette", {"rigde"}, 1.5, [7], -1):
            with self.assertRaises(drypoint.ArgumentError, msg=wrong):
                bits(wrong)

    def test_nearest_names(self):
        for make, near in (
            (lambda: drypoint.Style(ridge_angel=3), "ridge_angle"),
            (lambda: drypoint.Style().replace(papr="red"), "paper"),
            (lambda: color("firebrik"), "firebrick"),
            (lambda: drypoint.resolved({"shade": {"shading": "goch"}}), "gooch"),
            (lambda: drypoint.resolved({"line": {"rigde": {}}}), "ridge"),
            (lambda: drypoint.stroke_look("pencl"), "pencil"),
            (lambda: drypoint.Source.shape("blot"), "bolt"),
        ):
            with self.assertRaisesRegex(drypoint.ArgumentError, near):
                make()
        with self.assertRaises(AttributeError):
            drypoint.Style().ridge_angel = 3

    def test_wrong_values(self):
        for fields in (
            {"ridge_angle": "wide"},
            {"ridge_angle": 400.0},
            {"passes": 1.5},
            {"exact_ends": 1},
            {"edges": 9},
            {"edges": drypoint.Line.RIDGE},
            {"shade": {"light": (1, 2)}},
            {"shade": 3},
            {"line": [3]},
            {"hidden": {"levels": -1}},
            {"hidden": {"line": [{}] * 9}},
            {"stroke": {"texture": 7}},
            {"shade": {"shades": np.zeros((1, 4), np.uint8)}},
            {"shade": {"strokes": np.zeros((2, 2))}},
        ):
            with self.assertRaises(drypoint.ArgumentError, msg=fields):
                drypoint.resolved(fields)

    def test_names_of_fields_in_messages(self):
        with self.assertRaisesRegex(drypoint.ArgumentError, r"Style\.passes"):
            drypoint.resolved({"passes": "many"})

    def test_resolved_is_stable(self):
        style = drypoint.Style(
            line={"ridge": drypoint.LineStyle(3, "red")},
            hidden={"look": "dashed"},
            shade={"shading": "toon"},
        )
        once = drypoint.resolved(style)
        self.assertEqual(once, drypoint.resolved(once))
        self.assertEqual(once.line["ridge" and drypoint.Line.RIDGE].color, 0xFF0000FF)
        self.assertEqual(once.hidden.look, drypoint.HiddenLook.DASHED)

    def test_numpy_numbers(self):
        style = drypoint.Style(ridge_angle=np.float32(120), passes=np.int64(1), exact_ends=np.True_)
        self.assertEqual(drypoint.resolved(style).ridge_angle, 120)


class Pictures(unittest.TestCase):
    """Settings that change pictures."""

    def test_settings_are_seen(self):
        plain = drypoint.draw(drypoint.Source.shape("bolt"), **PICTURE).rgba
        texture = np.tile(np.array([[0, 255]], np.uint8), (4, 4))
        for style in (
            {"paper": "navy"},
            {"surface": (0.5, 0.5, 0.5)},
            {"line": {"silhouette": {"width": 6}}},
            {"lines": "ridge"},
            {"hidden": {"look": "dashed", "line": [{"ridge": {"color": "red"}}]}},
            {"xray": 0.4},
            {"shade": {"shading": "toon", "shades": np.full((1, 2, 4), 99, np.uint8)}},
            {"detail": 0.5},
            {"edge_map": {"detector": "diagonal", "inner": "green"}},
            {"ink": "quads"},
            {"mirror": {"normal": (0, 0, 1), "offset": -0.8, "size": 4}},
            {"stroke": drypoint.stroke_look("charcoal")},
            {"pattern": {"texture": "rope"}, "line": {"silhouette": {"width": 9}}},
            {"stroke": {"texture": texture}, "line": {"ridge": {"width": 5}}},
        ):
            with self.subTest(style):
                self.assertTrue(
                    (
                        drypoint.draw(drypoint.Source.shape("bolt"), style=style, **PICTURE).rgba
                        != plain
                    ).any()
                )

    def test_enhanced_groups(self):
        scene = drypoint.Source.join([drypoint.Source.shape("bolt"), drypoint.Source.shape("cube")])
        maps = [
            drypoint.draw(
                scene,
                style={"edge_map": {"detector": "diagonal", "enhanced": groups}},
                planes=["edge_map"],
                **PICTURE,
            ).edge_map
            for groups in ((), (1, 0))
        ]
        self.assertTrue((maps[0] != maps[1]).any())

    def test_styles_of_groups(self):
        scene = drypoint.Source.join(
            [drypoint.Source.shape("cube"), drypoint.Source.shape("bolt")], ["box", "screw"]
        )
        styles = {"box": {"surface": "red"}, 1: drypoint.Style(surface="blue", lines="none")}
        image = drypoint.draw(scene, group_styles=styles, **PICTURE)
        self.assertIn([255, 0, 0, 255], image.rgba.reshape(-1, 4).tolist())
        self.assertEqual(set(image.segments()["group"]), {0})
        for wrong in ({"bocks": None}, {-1: None}, {70000: None}):
            with self.assertRaises(drypoint.ArgumentError):
                drypoint.draw(scene, group_styles=wrong, **PICTURE)

    def test_textures(self):
        self.assertIn("pencil", drypoint.textures())
        texture = drypoint.Texture.from_array(np.zeros((3, 5, 3), np.uint8))
        self.assertEqual(texture.pixels.shape, (3, 5, 4))
        for wrong in (np.zeros((3, 5)), np.zeros(3, np.uint8), np.zeros((2, 2, 5), np.uint8), []):
            with self.assertRaises(drypoint.ArgumentError):
                drypoint.Texture.from_array(wrong)


class Cameras(unittest.TestCase):
    """From where, and through what."""

    def setUp(self):
        self.cube = drypoint.Source.shape("cube")

    def test_matrices(self):
        camera = drypoint.Camera.look_at((0, 0, 5), (0, 0, 0)).resolve(self.cube, (200, 100))
        np.testing.assert_allclose(camera.view @ (0, 0, 0, 1), (0, 0, -5, 1))
        again = drypoint.Camera(camera.view, camera.projection)
        one, two = (
            drypoint.draw(self.cube, camera=c, size=(200, 100)).rgba for c in (camera, again)
        )
        np.testing.assert_array_equal(one, two)
        clip = camera.projection @ camera.view @ (1, 1, 1, 1)
        self.assertAlmostEqual(clip[1] / clip[0], 2)  # a picture twice as wide as high

    def test_fit(self):
        for camera in (
            drypoint.Camera.fit(direction=(0, 0, 1)),
            drypoint.Camera.fit(drypoint.Fit(orthographic=True)),
            drypoint.Camera.fit({"zoom": 2}),
            drypoint.Camera.look_at((3, 2, 4), (0, 0, 0)).orthographic(4),
            drypoint.Camera.look_at((3, 2, 4), (0, 0, 0), up=(0, 0, 1)).perspective(
                50, near=0.1, far=100
            ),
        ):
            self.assertGreater(
                len(drypoint.draw(self.cube, camera=camera, **PICTURE).segments()), 0
            )

    def test_refused(self):
        look = drypoint.Camera.look_at((3, 2, 4), (0, 0, 0))
        for make in (
            lambda: drypoint.Camera.look_at((1, 1, 1), (1, 1, 1)),
            lambda: drypoint.Camera.look_at((1, 1), (0, 0, 0)),
            lambda: look.perspective(200).resolve(self.cube),
            lambda: look.orthographic(-1).resolve(self.cube),
            lambda: drypoint.Camera.fit(fov=3),
            lambda: drypoint.Camera.fit(zoom=-1).resolve(self.cube),
            lambda: drypoint.Camera(np.eye(3), np.eye(4)),
            lambda: drypoint.Camera.fit().perspective(),
            lambda: drypoint.Camera.fit().view,
            lambda: look.projection,
            lambda: drypoint.draw(
                self.cube, camera=drypoint.Camera(np.full((4, 4), np.nan), np.eye(4))
            ),
        ):
            with self.assertRaises(drypoint.ArgumentError):
                make()


if __name__ == "__main__":
    unittest.main()
