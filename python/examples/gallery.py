"""gallery.py [WxH] [OUTPUT]: the picture of docs/python.md, four drawings of arrays side by
side."""

import sys

import numpy as np

import drypoint


def tube(points, radius, sides):
    """(vertices, quads) around a closed curve, (n, 3)."""
    along = np.roll(points, -1, 0) - np.roll(points, 1, 0)
    across = np.cross(along, np.roll(along, -1, 0) - along)
    frame = [across / np.linalg.norm(across, axis=1, keepdims=True)]
    other = np.cross(along, frame[0])
    frame.append(other / np.linalg.norm(other, axis=1, keepdims=True))
    angles = np.linspace(0, 2 * np.pi, sides, endpoint=False)
    circle = sum(f[:, None] * g[:, None] for f, g in zip(frame, (np.cos(angles), np.sin(angles))))
    vertices = (points[:, None] + radius * circle).reshape(-1, 3)
    i, j = np.meshgrid(np.arange(len(points)), np.arange(sides), indexing="ij")
    next_i, next_j = (i + 1) % len(points), (j + 1) % sides
    corners = [(i, j), (next_i, j), (next_i, next_j), (i, next_j)]
    return vertices, np.stack([a * sides + b for a, b in corners], -1).reshape(-1, 4)


def knot():
    """A trefoil."""
    t = np.linspace(0, 2 * np.pi, 240, endpoint=False)
    curve = np.stack(
        [np.sin(t) + 2 * np.sin(2 * t), np.cos(t) - 2 * np.cos(2 * t), -np.sin(3 * t)], -1
    )
    return tube(curve, 0.55, 32)


def hill():
    """A height field as quads, and colours of its heights."""
    u, v = np.meshgrid(np.linspace(-3, 3, 97), np.linspace(-3, 3, 97), indexing="ij")
    height = 1.6 * np.exp(-(u**2 + v**2) / 3) * np.cos(2 * u) * np.cos(2 * v)
    corner = (np.arange(96)[:, None] * 97 + np.arange(96)).reshape(-1)
    faces = np.stack([corner, corner + 1, corner + 98, corner + 97], 1)
    share = ((height - height.min()) / np.ptp(height)).reshape(-1, 1)
    colors = (1 - share) * (0.25, 0.45, 0.7) + share * (1.0, 0.85, 0.6)
    return np.stack([u, height, v], -1).reshape(-1, 3), faces, colors


def depth_picture(depth):
    """Grey by distance, near is dark."""
    seen = np.isfinite(depth)
    near, far = depth[seen].min(), depth[seen].max()
    grey = np.where(
        seen, 60 + 170 * (np.where(seen, depth, far) - near) / (far - near), 255
    ).astype(np.uint8)
    return np.dstack([grey, grey, grey, np.full_like(grey, 255)])


def colored_lines(image, size):
    """The chains drawn by NumPy alone, dot by dot, coloured by distance."""
    picture = np.full((size[1], size[0], 4), 255, np.uint8)
    points = image.chains().points
    near, far = points["distance"].min(), points["distance"].max()
    for _, chain in image.chains().each():
        for a, b in zip(chain[:-1], chain[1:]):
            steps = np.linspace(0, 1, 2 + 2 * int(np.hypot(b["x"] - a["x"], b["y"] - a["y"])))
            x, y = (a[k] + (b[k] - a[k]) * steps for k in "xy")
            share = (a["distance"] - near) / (far - near)
            for dx, dy in ((0, 0), (1, 0), (0, 1), (1, 1)):  # a pen of 2 x 2 px
                row = np.clip(y.astype(int) + dy, 0, size[1] - 1)
                column = np.clip(x.astype(int) + dx, 0, size[0] - 1)
                picture[row, column, :3] = (220 * (1 - share), 60, 220 * share)
    return picture


def main(size, output):
    vertices, faces = knot()
    toon = drypoint.Style(
        shade={"shading": "toon"}, surface="lightsteelblue", line={"silhouette": {"width": 4}}
    )
    image = drypoint.draw(
        vertices,
        faces,
        style=toon,
        size=size,
        planes=["depth"],
        camera=drypoint.Camera.fit(direction=(0.2, 0.3, 1)),
    )
    land, quads, colors = hill()
    style = drypoint.Style(
        shade={"shading": "lambert", "model_colors": True},
        line={"silhouette": {"width": 3}, "border": {"width": 3}},
    )
    field = drypoint.draw(land, quads, colors=colors, style=style, size=size)
    row = [image.rgba, depth_picture(image.depth), colored_lines(image, size), field.rgba]
    whole = drypoint.Image((4 * size[0], size[1]))
    whole.rgba[:] = np.concatenate(row, axis=1)
    whole.save(output)


if __name__ == "__main__":
    width, height = sys.argv[1].split("x") if len(sys.argv) > 1 else (480, 400)
    main((int(width), int(height)), sys.argv[2] if len(sys.argv) > 2 else "python.png")
