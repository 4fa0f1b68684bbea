// Hairlines of a picture: where they darken it, and by how much.
#pragma once
#include <vector>

#include "sample_game/picture_scene.hpp"

namespace cullet {

/// What the picture's middle ray and its edges are: the direction through a point is forward + across * right + upwards
/// * up, across and upwards from -1 to 1 over the picture's height. Right and up are as long as half the height is wide
/// at distance 1.
struct PictureFrame {
    Vec3 eye, forward, right, up;
    uint32_t width = 0, height = 0;
};

/// What a pixel shows: the first opaque thing, and the body of the first face of all.
struct PixelFace {
    uint32_t body = kSkyBody, front = kSkyBody;
    FaceKind kind = FaceKind::Outer;
    float distance = kViewFar;  // m, of the opaque thing
    float slope = 1;            // cosine between its face and the ray of sight
};

/// Ink of all bodies' lines in each pixel, 0 to 1, row by row: a bell of 0.55 pixels about the line, the most of all
/// lines. A line shows where the pixel's first face is of its body and kind and no nearer than it, or its body's glass.
/// Lines that pass behind the eye are left out. O(pixels within two of a line).
std::vector<float> hairline_ink(std::span<const DrawnBody> bodies, const PictureFrame& frame,
                                std::span<const PixelFace> faces);

}  // namespace cullet
