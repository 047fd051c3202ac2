#!/usr/bin/env python3
"""gltf.py PRINT_POSE: do scenes of glTF move as its specification says?

Evaluates models with numpy, from the text of glTF 2.0 alone (sections 3.6 to 3.11 and appendix C), and compares the corners
of all polygons at several times with those of the library, which PRINT_POSE prints: positions within 1e-5 of the
model's size, normals within 1e-3. Models: some that are written here, and those of Debian's assimp-testmodels, which are
left out where they are not installed. Exit status 77: there is no numpy."""
import base64, glob, json, math, os, struct, subprocess, sys, tempfile, urllib.parse

try:
    import numpy as np
except ImportError:
    print("skipped: there is no numpy")
    sys.exit(77)

TYPES = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
LIMITS = {5120: 127.0, 5121: 255.0, 5122: 32767.0, 5123: 65535.0}
failed = done = 0


def tell(good, what, why=""):
    global failed, done
    done += 1
    failed += not good
    print(("ok " if good else "not ok ") + what + (" (%s)" % why if why else ""))


# ------- reading (3.6) -------


class Model:
    def __init__(self, path):
        data = open(path, "rb").read()
        self.folder, self.chunk = os.path.dirname(path), None
        if data[:4] == b"glTF":
            size = struct.unpack_from("<I", data, 12)[0]
            self.json = json.loads(data[20:20 + size])
            self.chunk = data[28 + size:]
        else:
            self.json = json.loads(data)
        self.buffers = [self.buffer(b) for b in self.json.get("buffers", [])]

    def list(self, name):
        return self.json.get(name, [])

    def buffer(self, b):
        uri = b.get("uri")
        if uri is None:
            return self.chunk
        if uri.startswith("data:"):
            return base64.b64decode(uri.split(",", 1)[1])
        return open(os.path.join(self.folder, urllib.parse.unquote(uri)), "rb").read()

    def view(self, number, offset, kind, count, width, stride):
        v = self.list("bufferViews")[number]
        start = v.get("byteOffset", 0) + offset
        size = np.dtype(kind).itemsize
        stride = v.get("byteStride", 0) if stride else 0
        rows = [np.frombuffer(self.buffers[v["buffer"]], kind, width, start + i * (stride or size * width))
                for i in range(count)]
        return np.array(rows).reshape(count, width)

    def accessor(self, number):
        a = self.list("accessors")[number]
        kind, width, count = TYPES[a["componentType"]], WIDTHS[a["type"]], a["count"]
        if "bufferView" in a:
            rows = self.view(a["bufferView"], a.get("byteOffset", 0), kind, count, width, True).copy()
        else:
            rows = np.zeros((count, width), kind)
        if "sparse" in a:
            s, i, v = a["sparse"], a["sparse"]["indices"], a["sparse"]["values"]
            at = self.view(i["bufferView"], i.get("byteOffset", 0), TYPES[i["componentType"]], s["count"], 1, False)
            rows[at[:, 0]] = self.view(v["bufferView"], v.get("byteOffset", 0), kind, s["count"], width, False)
        rows = rows.astype(np.float64)
        if a.get("normalized"):
            rows = np.maximum(rows / LIMITS[a["componentType"]], -1)
        return rows


# ------- animation (3.11, appendix C) -------


def unit(q):
    return q / np.linalg.norm(q)


def slerp(a, b, t):
    a, b = unit(a), unit(b)
    d = a @ b
    s = 1 if d >= 0 else -1
    angle = math.acos(min(abs(d), 1))
    if angle < 1e-9:
        return unit((1 - t) * a + s * t * b)
    return (math.sin(angle * (1 - t)) * a + s * math.sin(angle * t) * b) / math.sin(angle)


def sampled(model, sampler, path, width, t):
    times = model.accessor(sampler["input"])[:, 0]
    kind = sampler.get("interpolation", "LINEAR")
    values = model.accessor(sampler["output"]).reshape(len(times), 3 if kind == "CUBICSPLINE" else 1, width)
    at = min(max(t, times[0]), times[-1])
    k = min(int(np.searchsorted(times, at, side="right")) - 1, len(times) - 1)
    value = values[:, 1 if kind == "CUBICSPLINE" else 0]
    if k + 1 == len(times) or kind == "STEP":
        result = value[k]
    else:
        span = times[k + 1] - times[k]
        u = (at - times[k]) / span
        if kind == "CUBICSPLINE":
            b, a = values[k, 2], values[k + 1, 0]
            result = ((2 * u**3 - 3 * u**2 + 1) * value[k] + span * (u**3 - 2 * u**2 + u) * b
                      + (-2 * u**3 + 3 * u**2) * value[k + 1] + span * (u**3 - u**2) * a)
        elif path == "rotation":
            result = slerp(value[k], value[k + 1], u)
        else:
            result = (1 - u) * value[k] + u * value[k + 1]
    return unit(result) if path == "rotation" else result


def morph_count(model, node):
    return len(model.list("meshes")[node["mesh"]]["primitives"][0].get("targets", []))


def overrides(model, clip, t):
    found = {}
    if clip is None:
        return found
    for c in clip["channels"]:
        node, path = c["target"].get("node"), c["target"]["path"]
        if node is None or path not in ("translation", "rotation", "scale", "weights"):
            continue
        width = {"rotation": 4, "weights": 0}.get(path, 3) or morph_count(model, model.list("nodes")[node])
        found[node, path] = sampled(model, clip["samplers"][c["sampler"]], path, width, t)
    return found


# ------- nodes (3.5) -------


def turn(q):
    x, y, z, w = unit(np.array(q, float))
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def matrix_of(translation, rotation, scale):
    m = np.eye(4)
    m[:3, :3] = turn(rotation) @ np.diag(scale)
    m[:3, 3] = translation
    return m


def local(model, number, moved):
    node = model.list("nodes")[number]
    if "matrix" in node:
        return np.array(node["matrix"], float).reshape(4, 4).T
    part = lambda name, rest: moved.get((number, name), node.get(name, rest))
    return matrix_of(part("translation", [0, 0, 0]), part("rotation", [0, 0, 0, 1]), part("scale", [1, 1, 1]))


def worlds(model, moved):
    nodes, found = model.list("nodes"), {}
    children = {c for n in nodes for c in n.get("children", [])}

    def go(number, parent):
        found[number] = parent @ local(model, number, moved)
        for c in nodes[number].get("children", []):
            go(c, found[number])

    for i in range(len(nodes)):
        if i not in children:
            go(i, np.eye(4))
    return found


# ------- meshes and skins (3.7) -------


def corners_of(model, primitive, count):
    v = np.arange(count)
    if "indices" in primitive:
        v = model.accessor(primitive["indices"])[:, 0].astype(int)
    mode = primitive.get("mode", 4)
    if mode == 4:
        return v[:len(v) // 3 * 3].reshape(-1, 3)
    if mode == 5:
        return np.array([[v[i], v[i + 1 + i % 2], v[i + 2 - i % 2]] for i in range(len(v) - 2)])
    if mode == 6:
        return np.array([[v[i + 1], v[i + 2], v[0]] for i in range(len(v) - 2)])
    return np.zeros((0, 3), int)


def morphed(model, primitive, name, weights):
    rows = model.accessor(primitive["attributes"][name])
    for target, weight in zip(primitive.get("targets", []), weights):
        if name in target:
            rows = rows + weight * model.accessor(target[name])
    return rows


def skin_matrices(model, primitive, skin, found):
    binds = [np.eye(4)] * len(skin["joints"])
    if "inverseBindMatrices" in skin:
        binds = [m.reshape(4, 4).T for m in model.accessor(skin["inverseBindMatrices"])]
    joints = np.array([found[j] @ b for j, b in zip(skin["joints"], binds)])
    total = weight_sum = 0
    for k in range(99):
        if "JOINTS_%d" % k not in primitive["attributes"]:
            break
        j = model.accessor(primitive["attributes"]["JOINTS_%d" % k]).astype(int)
        w = model.accessor(primitive["attributes"]["WEIGHTS_%d" % k])
        total = total + np.einsum("vi,viab->vab", w, joints[j])
        weight_sum = weight_sum + w.sum(axis=1)
    return total / weight_sum[:, None, None]


def place(primitive, model, matrices, weights):
    """Corners [polygon][3][position, normal]; matrices: one for each vertex."""
    p = morphed(model, primitive, "POSITION", weights)
    if len(matrices) == 1:
        matrices = np.repeat(matrices, len(p), axis=0)
    world = np.einsum("vab,vb->va", matrices[:, :3, :3], p) + matrices[:, :3, 3]
    n = np.zeros_like(world)
    if "NORMAL" in primitive["attributes"]:
        rest = morphed(model, primitive, "NORMAL", weights)
        for i, m in enumerate(matrices[:, :3, :3]):
            flat = abs(np.linalg.det(m)) < 1e-12 # it has no normal to compare
            n[i] = np.nan if flat else np.linalg.inv(m).T @ rest[i]
        length = np.linalg.norm(n, axis=1)
        n = n / np.where(length == 0, 1, length)[:, None]
    return np.concatenate([world, n], axis=1)[corners_of(model, primitive, len(p))]


def copies(model, node):
    """Transforms of EXT_mesh_gpu_instancing."""
    attributes = node.get("extensions", {}).get("EXT_mesh_gpu_instancing", {}).get("attributes")
    if attributes is None:
        return [np.eye(4)]
    parts = {k: model.accessor(a) for k, a in attributes.items()}
    count = len(next(iter(parts.values())))
    one = lambda k, i, rest: parts[k][i] if k in parts else rest
    return [matrix_of(one("TRANSLATION", i, [0, 0, 0]), one("ROTATION", i, [0, 0, 0, 1]), one("SCALE", i, [1, 1, 1]))
            for i in range(count)]


def polygons(model, clip, t):
    moved = overrides(model, clip, t)
    found = worlds(model, moved)
    nodes, scenes, all_polygons = model.list("nodes"), model.list("scenes"), []

    def visit(number):
        node = nodes[number]
        if "mesh" in node:
            mesh = model.list("meshes")[node["mesh"]]
            weights = moved.get((number, "weights"), node.get("weights", mesh.get("weights", [])))
            for copy in copies(model, node):
                for primitive in mesh["primitives"]:
                    if "POSITION" not in primitive["attributes"]:
                        continue
                    skinned = "skin" in node and "JOINTS_0" in primitive["attributes"]
                    if skinned:
                        m = skin_matrices(model, primitive, model.list("skins")[node["skin"]], found)
                    else:
                        m = (found[number] @ copy)[None]
                    c = place(primitive, model, m, weights)
                    if len(c):
                        all_polygons.append(c[:, ::-1] if not skinned and np.linalg.det(m[0][:3, :3]) < 0 else c)
        for c in node.get("children", []):
            visit(c)

    if scenes:
        roots = scenes[model.json.get("scene", 0)].get("nodes", [])
    else:
        roots = [i for i in range(len(nodes)) if not any(i in n.get("children", []) for n in nodes)]
    for r in roots:
        visit(r)
    return np.concatenate(all_polygons) if all_polygons else np.zeros((0, 3, 6))


# ------- comparing -------


def printed(program, path, clip, times):
    out = subprocess.run([program, path, str(clip)] + ["%.17g" % t for t in times], stdout=subprocess.PIPE, check=True).stdout
    found, at = [], 0
    for _ in times:
        count = struct.unpack_from("<Q", out, at)[0]
        found.append(np.frombuffer(out, "<f8", 6 * count, at + 8).reshape(-1, 3, 6))
        at += 8 + 48 * count
    return found


def differences(expected, found):
    """Of positions, by the model's size, and of normals; NaN and infinities must stand in the same places."""
    if expected.shape != found.shape:
        return math.inf, math.inf
    p, q = expected[:, :, :3], found[:, :, :3]
    sound = np.isfinite(p).all(axis=(1, 2)) & np.isfinite(q).all(axis=(1, 2))
    if (np.isfinite(p).all(axis=(1, 2)) != np.isfinite(q).all(axis=(1, 2))).any() or not sound.any():
        return math.inf, math.inf
    p, q = p[sound], q[sound]
    size = np.ptp(p.reshape(-1, 3), axis=0).max()
    n, m = expected[sound][:, :, 3:], found[sound][:, :, 3:]
    length = np.linalg.norm(m, axis=2)
    m = m / np.where(length > 0, length, 1)[:, :, None]
    return np.abs(p - q).max() / max(size, 1e-30), np.nan_to_num(np.abs(n - m)).max()


def compare(program, path, name):
    model = Model(path)
    clips = model.list("animations")
    worst_p = worst_n = count = 0
    for number in range(len(clips) + 1):
        clip = clips[number - 1] if number else None
        ends = [model.accessor(s["input"])[:, 0] for s in clip["samplers"]] if clip else [np.array([0.0, 1.0])]
        first, last = min(e.min() for e in ends), max(e.max() for e in ends)
        times = [first + s * (last - first) for s in (0, 0.137, 0.5, 0.791, 1)] + [first - 1, last + 1]
        for t, found in zip(times, printed(program, path, number, times)):
            p, n = differences(polygons(model, clip, t), found)
            worst_p, worst_n, count = max(worst_p, p), max(worst_n, n), count + 1
    tell(worst_p <= 1e-5 and worst_n <= 1e-3, name,
         "%d poses, positions within %.1g of the size, normals within %.1g" % (count, worst_p, worst_n))


# ------- models that are written here -------


class Writer:
    """A glTF file in the making; everything in one buffer."""

    def __init__(self):
        self.data, self.json = b"", {"asset": {"version": "2.0"}, "accessors": [], "bufferViews": [], "nodes": [],
                                     "meshes": [], "scenes": [{"nodes": []}], "scene": 0}

    def view(self, array, stride=None):
        data = np.ascontiguousarray(array).tobytes()
        self.data += b"\0" * (-len(self.data) % 4)
        self.json["bufferViews"].append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(data)})
        if stride:
            self.json["bufferViews"][-1]["byteStride"] = stride
        self.data += data
        return len(self.json["bufferViews"]) - 1

    def accessor(self, values, kind=5126, normalized=False, **more):
        values = np.array(values, float)
        values = values.reshape(len(values), -1)
        if normalized:
            values = np.round(values * LIMITS[kind])
        width = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}[values.shape[1]]
        a = {"componentType": kind, "count": len(values), "type": width, **more}
        size = np.dtype(TYPES[kind]).itemsize * values.shape[1]
        pad = -size % 4 if kind in LIMITS and len(values) > 1 and values.shape[1] > 1 else 0
        rows = values.astype(TYPES[kind])
        if pad: # vertices lie at multiples of 4
            rows = np.concatenate([rows.view("u1").reshape(len(rows), size), np.zeros((len(rows), pad), "u1")], axis=1)
        a["bufferView"] = self.view(rows, size + pad if pad else None)
        if normalized:
            a["normalized"] = True
        self.json["accessors"].append(a)
        return len(self.json["accessors"]) - 1

    def mesh(self, attributes, more=None, **mesh):
        self.json["meshes"].append({"primitives": [{"attributes": attributes, **(more or {})}], **mesh})
        return len(self.json["meshes"]) - 1

    def node(self, root=True, **node):
        self.json["nodes"].append(node)
        if root:
            self.json["scenes"][0]["nodes"].append(len(self.json["nodes"]) - 1)
        return len(self.json["nodes"]) - 1

    def clip(self, *channels):
        """(node, path, interpolation, times, values[, component type]) each."""
        clip = {"samplers": [], "channels": []}
        for node, path, kind, times, values, *component in channels:
            flat = np.array(values, float)
            flat = flat.reshape(-1, 1) if path == "weights" else flat.reshape(-1, 4 if path == "rotation" else 3)
            output = self.accessor(flat, *component, normalized=bool(component))
            clip["samplers"].append({"input": self.accessor(times), "output": output, "interpolation": kind})
            clip["channels"].append({"sampler": len(clip["samplers"]) - 1, "target": {"node": node, "path": path}})
        self.json.setdefault("animations", []).append(clip)

    def save(self, path):
        self.json["buffers"] = [{"byteLength": len(self.data)}]
        if path.endswith(".glb"):
            text = json.dumps(self.json).encode()
            text += b" " * (-len(text) % 4)
            data = self.data + b"\0" * (-len(self.data) % 4)
            chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(data), 0x004E4942) + data
            open(path, "wb").write(struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks)
            return
        self.json["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64.b64encode(self.data).decode()
        json.dump(self.json, open(path, "w"))


def ball(random, count=40):
    """Points on a ball, their normals, and triangles between any of them."""
    p = random.normal(size=(count, 3))
    p /= np.linalg.norm(p, axis=1)[:, None]
    return p, random.integers(0, count, size=(60, 3))


def simple(w, random, **more):
    p, t = ball(random)
    return w.mesh({"POSITION": w.accessor(p), "NORMAL": w.accessor(p)}, {"indices": w.accessor(t.ravel(), 5123), **more})


def quaternions(random, count):
    q = random.normal(size=(count, 4))
    return q / np.linalg.norm(q, axis=1)[:, None]


def all_interpolations(random):
    w = Writer()
    mesh = simple(w, random)
    times = [0.5, 1.25, 1.5, 4]
    for k, kind in enumerate(("LINEAR", "STEP", "CUBICSPLINE")):
        each = 3 if kind == "CUBICSPLINE" else 1
        arm = w.node(translation=[3 * k, 0, 0], scale=[1, 2, 0.5])
        hand = w.node(root=False, mesh=mesh)
        w.json["nodes"][arm]["children"] = [hand]
        w.clip((arm, "rotation", kind, times, quaternions(random, 4 * each)),
               (hand, "translation", kind, times, random.normal(size=(4 * each, 3))),
               (hand, "scale", kind, times, random.normal(size=(4 * each, 3))))
    w.clip((0, "rotation", "LINEAR", [0, 1, 2], quaternions(random, 3), 5122),
           (0, "translation", "LINEAR", [2], [[1, 2, 3]]))
    return w


def mirrored(random):
    w = Writer()
    mesh = simple(w, random)
    a = w.node(scale=[-1, 1, 2], rotation=[0.5, 0.5, 0.5, 0.5])
    b = w.node(root=False, mesh=mesh, matrix=[1, 0.3, 0, 0, -0.2, 1, 0, 0, 0.1, 0, -3, 0, 5, 6, 7, 1])
    c = w.node(root=False, mesh=mesh, scale=[1, 1, 1])
    w.json["nodes"][a]["children"] = [b, c]
    w.clip((c, "scale", "LINEAR", [0, 2], [[1, 1, 1], [-1, 1, 1]]), (a, "translation", "STEP", [0, 1], [[0, 0, 0], [9, 0, 0]]))
    return w


def morphs(random):
    w = Writer()
    p, t = ball(random)
    target = lambda: {"POSITION": w.accessor(random.normal(size=p.shape)), "NORMAL": w.accessor(0.2 * random.normal(size=p.shape))}
    empty = {"componentType": 5126, "count": len(p), "type": "VEC3",
             "sparse": {"count": 3, "indices": {"bufferView": w.view(np.array([1, 7, 30], "<u2")), "componentType": 5123},
                        "values": {"bufferView": w.view(random.normal(size=(3, 3)).astype("<f4"))}}}
    w.json["accessors"].append(empty)
    mesh = w.mesh({"POSITION": w.accessor(p), "NORMAL": w.accessor(p)},
                  {"indices": w.accessor(t.ravel(), 5121), "targets": [target(), {"POSITION": 0}, target()]},
                  weights=[0.5, 0.25, 0])
    a = w.node(mesh=mesh)
    b = w.node(mesh=mesh, weights=[0, 0, 1], translation=[4, 0, 0], scale=[1, 3, 1])
    times = [0, 1, 3]
    w.clip((a, "weights", "LINEAR", times, random.uniform(size=(3, 3))))
    w.clip((b, "weights", "CUBICSPLINE", times, random.normal(size=(3, 3, 3))), (a, "weights", "STEP", times, random.uniform(size=(3, 3))))
    return w


def skins(random, sets, kind):
    """Two skins of one mesh; `kind`: the weights' components."""
    w = Writer()
    p, t = ball(random)
    attributes = {"POSITION": w.accessor(p), "NORMAL": w.accessor(p)}
    weights = random.uniform(size=(len(p), 4 * sets)) + 0.01
    if kind == 5126: # also those that do not sum to one
        weights[::2] /= weights[::2].sum(axis=1)[:, None]
    for k in range(sets):
        attributes["JOINTS_%d" % k] = w.accessor(random.integers(0, 3, size=(len(p), 4)), 5121 if k else 5123)
        attributes["WEIGHTS_%d" % k] = w.accessor(weights[:, 4 * k:4 * k + 4] / 2, kind, normalized=kind != 5126)
    mesh = w.mesh(attributes, {"indices": w.accessor(t.ravel(), 5125)})
    root = w.node(translation=[0, 1, 0], scale=[1, 1.5, 1])
    joints = [w.node(root=False, rotation=list(q), translation=list(random.normal(size=3)), scale=[1, 1, 1 + 0.2 * i])
              for i, q in enumerate(quaternions(random, 3))]
    w.json["nodes"][root]["children"] = joints[:1]
    w.json["nodes"][joints[0]]["children"] = joints[1:]
    binds = np.array([np.linalg.inv(matrix_of(random.normal(size=3), q, [1, 1, 1])).T.ravel() for q in quaternions(random, 3)])
    w.json["skins"] = [{"joints": joints, "inverseBindMatrices": w.accessor(binds)}, {"joints": joints[::-1], "skeleton": root}]
    w.node(mesh=mesh, skin=0, translation=[100, 0, 0])
    other = w.node(root=False, mesh=mesh, skin=1)
    w.node(children=[other], scale=[7, 7, 7])
    times = [0, 0.5, 2]
    w.clip((joints[1], "rotation", "LINEAR", times, quaternions(random, 3)),
           (root, "translation", "CUBICSPLINE", times, random.normal(size=(9, 3))),
           (joints[0], "scale", "LINEAR", times, random.uniform(0.5, 2, size=(3, 3))))
    return w


def odd_accessors(random):
    w = Writer()
    p, t = ball(random)
    quantized = {"POSITION": w.accessor(p, 5122, True), "NORMAL": w.accessor(p, 5120, True)}
    whole = {"POSITION": w.accessor(np.round(20 * p), 5120)}
    w.node(mesh=w.mesh(quantized, {"indices": w.accessor(t.ravel(), 5121)}), scale=[2, 2, 2])
    w.node(mesh=w.mesh(whole, {"mode": 5}), scale=[0.1, 0.1, 0.1], translation=[3, 0, 0])
    w.node(mesh=w.mesh({"POSITION": w.accessor(p)}, {"mode": 6, "indices": w.accessor((t.ravel()[:30] + 5) % 40, 5125)}))
    w.node(mesh=w.mesh({"POSITION": w.accessor(p)}), translation=[0, -4, 0])
    sparse = w.accessor(p)
    w.json["accessors"][sparse]["sparse"] = {
        "count": 2, "indices": {"bufferView": w.view(np.array([3, 9], "<u4")), "componentType": 5125},
        "values": {"bufferView": w.view(np.array([[9, 9, 9], [-9, 0, 0]], "<f4"))}}
    w.node(mesh=w.mesh({"POSITION": sparse}, {"indices": w.accessor(t.ravel(), 5123)}))
    both = np.zeros((len(p), 6), "<f4") # interleaved
    both[:, :3], both[:, 3:] = p, p[::-1]
    view = w.view(both, 24)
    first = len(w.json["accessors"])
    w.json["accessors"] += [{"bufferView": view, "byteOffset": 12 * k, "componentType": 5126, "count": len(p), "type": "VEC3"}
                            for k in range(2)]
    w.node(mesh=w.mesh({"POSITION": first, "NORMAL": first + 1}), translation=[0, 5, 0])
    del w.json["scenes"], w.json["scene"] # all roots
    return w


def instanced(random):
    w = Writer()
    attributes = {"TRANSLATION": w.accessor(5 * random.normal(size=(9, 3))), "ROTATION": w.accessor(quaternions(random, 9), 5122, True),
                  "SCALE": w.accessor(random.normal(size=(9, 3)))}
    n = w.node(mesh=simple(w, random), rotation=[0, 0.6, 0, 0.8], extensions={"EXT_mesh_gpu_instancing": {"attributes": attributes}})
    w.clip((n, "translation", "LINEAR", [0, 1], [[0, 0, 0], [0, 9, 0]]))
    return w


def far_away(random):
    w = Writer()
    n = w.node(translation=[512345.25, 5400000.5, 0], children=[1])
    w.node(root=False, mesh=simple(w, random))
    w.clip((1, "rotation", "LINEAR", [0, 1], quaternions(random, 2)))
    return w


def written(program, folder):
    random = np.random.default_rng(7)
    models = {"interpolations.gltf": all_interpolations(random), "mirrored.gltf": mirrored(random), "morphs.gltf": morphs(random),
              "four-influences.gltf": skins(random, 1, 5121), "eight-influences.glb": skins(random, 2, 5126),
              "twelve-influences.gltf": skins(random, 3, 5123), "odd-accessors.gltf": odd_accessors(random),
              "instanced.glb": instanced(random), "far-away.gltf": far_away(random)}
    for name, w in models.items():
        path = os.path.join(folder, name)
        w.save(path)
        compare(program, path, name)


# Models that no reader can read, or that say so (glTF 1.0, Draco, broken on purpose: infinities, say).
BROKEN = ("/glTF/", "draco", "NoScene", "SceneWithoutNodes", "SchemaFailures", "IndexOutOfRange", "wrongTypes", "RecursiveNodes",
          "MissingBin", "BoxWithInfinites")


def has_triangles(model):
    return any(p.get("mode", 4) >= 4 for m in model.list("meshes") for p in m["primitives"])


def installed(program):
    folder = "/usr/share/assimp/models"
    paths = sorted(glob.glob(folder + "/**/*.gltf", recursive=True) + glob.glob(folder + "/**/*.glb", recursive=True))
    paths += sorted(glob.glob(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../../shared/cases/*.gltf")))
    if not paths:
        print("skipped: models of Debian's assimp-testmodels, as it is not installed")
    for path in paths:
        if any(word in path for word in BROKEN) or not has_triangles(Model(path)):
            continue
        compare(program, path, os.path.relpath(path, folder) if path.startswith(folder) else os.path.basename(path))


if len(sys.argv) != 2:
    sys.exit(__doc__)
with tempfile.TemporaryDirectory() as folder:
    written(sys.argv[1], folder)
installed(sys.argv[1])
print("%d of %d models move as glTF says" % (done - failed, done))
sys.exit(failed > 0)
