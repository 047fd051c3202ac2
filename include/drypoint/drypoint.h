/* Everything in the core library. drypoint/io.h (files through libpng and Assimp) and drypoint/gl.h (drawings by
 * OpenGL) stand apart. */
#ifndef DRYPOINT_DRYPOINT_H
#define DRYPOINT_DRYPOINT_H

#include <drypoint/adjacency.h>
#include <drypoint/base.h>
#include <drypoint/camera.h>
#include <drypoint/deform.h>
#include <drypoint/draw.h>
#include <drypoint/drawing.h>
#include <drypoint/immediate.h>
#include <drypoint/objects.h>
#include <drypoint/scene.h>
#include <drypoint/path.h>
#include <drypoint/section.h>
#include <drypoint/shade.h>
#include <drypoint/shapes.h>
#include <drypoint/sink.h>
#include <drypoint/source.h>
#include <drypoint/strokes.h>
#include <drypoint/style.h>

#endif
