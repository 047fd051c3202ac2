"""turntable.py [WxH] [MODEL]: draws a model from 12 sides, frames turn-00.png to turn-11.png.

One source and one context serve all frames; the camera keeps its distance.
"""

import math
import sys

import drypoint


def main(size, model):
    source = drypoint.Source.open(model) if model else drypoint.Source.shape("bracket")
    style = drypoint.Style(line={"silhouette": {"width": 3}}, hidden={"look": "dotted"})
    image = None
    for frame in range(12):
        angle = 2 * math.pi * frame / 12
        camera = drypoint.Camera.fit(direction=(math.sin(angle), 0.5, math.cos(angle)), steady=True)
        image = drypoint.draw(source, camera=camera, style=style, size=size, out=image)
        image.save(f"turn-{frame:02}.png")


if __name__ == "__main__":
    width, height = sys.argv[1].split("x") if len(sys.argv) > 1 else (800, 600)
    main((int(width), int(height)), sys.argv[2] if len(sys.argv) > 2 else None)
