#!/usr/bin/env python3
"""svg_boxes.py FILE: the views of an SVG that drypoint wrote, as "x0 y0 x1 y1" in mm, from left to right: paths of
lines (not of frames, texts and grounds) whose boxes lie nearer than 4 mm to each other belong together."""
import re
import sys
import xml.etree.ElementTree as tree

NEAR = 4  # mm


def box_of(data):
    tokens = re.findall(r'[A-Za-z]|[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?', data)
    x = y = start_x = start_y = 0.0
    command, i, points = '', 0, []
    while i < len(tokens):
        if tokens[i].isalpha():
            command, i = tokens[i], i + 1
            if command in 'zZ':
                x, y = start_x, start_y
                continue
        origin = (x, y) if command.islower() else (0.0, 0.0)
        if command in 'hH':
            x, i = origin[0] + float(tokens[i]), i + 1
        elif command in 'vV':
            y, i = origin[1] + float(tokens[i]), i + 1
        else:
            x, y, i = origin[0] + float(tokens[i]), origin[1] + float(tokens[i + 1]), i + 2
        if command in 'mM':
            start_x, start_y, command = x, y, 'l' if command == 'm' else 'L'
        points.append((x, y))
    xs, ys = zip(*points)
    return [min(xs), min(ys), max(xs), max(ys)]


def near(a, b):
    return all(a[k] - b[k + 2] < NEAR and b[k] - a[k + 2] < NEAR for k in range(2))


def main():
    root = tree.parse(sys.argv[1]).getroot()
    mm = float(root.get('width').removesuffix('mm')) / float(root.get('viewBox').split()[2])
    boxes = []
    for layer in root:
        if re.match(r'(silhouette|ridge|valley|border|intersection)', layer.get('id') or ''):
            boxes += [[mm * at for at in box_of(p.get('d'))] for p in layer.iter() if p.get('d')]
    views = []
    for box in boxes:
        while True:
            other = next((v for v in views if near(v, box)), None)
            if not other:
                break
            views.remove(other)
            box = [min(box[0], other[0]), min(box[1], other[1]), max(box[2], other[2]), max(box[3], other[3])]
        views.append(box)
    for view in sorted(views):
        print(*('%.3f' % at for at in view))


main()
