#!/usr/bin/env python3
"""Scores drypoint's pictures of models that move, at times, with the independent oracle (../shared/oracle).

    tests/accuracy/posed.py --build build/check-gcc

A program of the tests (bench_posed) writes the model as it is at a time; `drypoint MODEL --time T` draws the lines
of the moving model, and the oracle scores them on that mesh, and beside them those of the mesh itself, which stands
still. Asked for is what is asked of clean meshes, or, where a model is none (bent quads, whose diagonals the oracle
takes for folds; seams between skins, which it takes for borders), what the still mesh has. Prints a Markdown table; exits 1 if a figure is
missed, and 0, saying so, where ../shared or Debian's assimp-testmodels are not there.
"""
import argparse
import pathlib
import subprocess
import sys
import tempfile

import oracle

MODELS = pathlib.Path("/usr/share/assimp/models")
CASES = [  # file, animation, seconds
    ("X/Testwuson.X", 1, (0.3, 0.6)),
    ("X/Testwuson.X", 2, (1.7,)),
    ("X/BCN_Epileptic.X", 1, (0.5, 1.5, 2.5)),
    ("FBX/huesitos.fbx", 1, (0.3, 1.5)),
    ("FBX/animation_with_skeleton.fbx", 1, (0.3,)),
    ("MDL/MDL (HL1)/man.mdl", 2, (0.2,)),
    ("BVH/Boxing_Toes.bvh", 1, (5,)),
    ("ASE/MotionCaptureROM.ase", 1, (5, 15)),
    ("Collada/anims_with_full_rotations_between_keys.DAE", 1, (3,)),
    ("glTF2/glTF-Sample-Models/AnimatedMorphCube-glTF/AnimatedMorphCube.gltf", 1, (0.3, 0.7)),
    ("glTF2/simple_skin/simple_skin.gltf", 1, (1.2,)),
]
FIGURES = {"silhouette": (0.998, 0.995), "all": (0.995, 0.995)}


def score(options, program, model, mesh, cls, view):
    """Recall and precision of the picture of a model (a file and options) on a mesh."""
    picture, tool = options.out / "posed.png", options.build / "drypoint"
    case = oracle.Case(mesh, view, cls, 2)
    eye, target, fov = oracle.camera_of(mesh, view)
    subprocess.run(
        [tool, *model, "-o", picture, "--size", "1680x1050",
         "--samples", "16", "--eye=" + ",".join(eye), "--target=" + ",".join(target), "--up", "0,1,0", "--fov", fov,
         "--lines", oracle.CLASSES[cls][0], "--width", "2", "--detail", "exact", "--ridge-angle", str(case.theta),
         "--valley-angle", str(case.phi), "--quiet"], check=True)
    done = subprocess.run(oracle.oracle_command(program, case, picture), check=True, capture_output=True, text=True)
    words = done.stdout.split()
    scores = dict(zip(words[::2], map(float, words[1::2])))
    return scores["recall"], scores["precision"]


def pose(options, file, clip, time):
    """Writes the model at that time; the mesh."""
    mesh = options.out / "posed.ply"
    subprocess.run([options.build / "tests" / "bench_posed", MODELS / file, str(clip), str(time), mesh], check=True)
    oracle.camera_of.__defaults__[0].clear()  # the mesh's box is another one each time
    return mesh


def main():
    parser = argparse.ArgumentParser(description="Scores pictures of models that move.")
    parser.add_argument("--build", type=pathlib.Path, default=oracle.ROOT / "build" / "check-gcc")
    parser.add_argument("--views", default="peers,left")
    options = parser.parse_args()
    shared = oracle.ROOT.parent / "shared"
    if not shared.is_dir() or not MODELS.is_dir():
        print("posed: skipped, there is no %s" % (MODELS if shared.is_dir() else shared))
        return 0
    program = oracle.build_oracle(shared, options.build)
    missed = 0
    print("| model | animation | s | view | class | recall | precision | the same, still | |\n"
          "|---|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        options.out = pathlib.Path(folder)
        for file, clip, time in [(f, c, t) for f, c, times in CASES for t in times]:
            mesh = pose(options, file, clip, time)
            for view, cls in [(v, c) for v in options.views.split(",") for c in FIGURES]:
                model = [MODELS / file, "--animation", str(clip), "--time", str(time)]
                moving = score(options, program, model, mesh, cls, view)
                still = score(options, program, [mesh], mesh, cls, view)
                bad = any(m < min(s, f) for m, s, f in zip(moving, still, FIGURES[cls]))
                missed += bad
                print("| %s | %d | %g | %s | %s | %.4f | %.4f | %.4f, %.4f | %s |" % (
                    file, clip, time, view, cls, *moving, *still, "missed" if bad else ""))
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
