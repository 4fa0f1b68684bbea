// What materials look like: colour, shine and unevenness at a place of a body, out of formulas and no files. A pattern
// lies in the frame of the cooked mesh, which pieces keep: courses of bricks go on from piece to piece, and with them.
#pragma once
#include <cstdint>
#include <string>

#include "engine/math.hpp"

namespace cullet {

/// Of a run's pictures. Pieces: a colour a piece, lines between them, to judge a break by.
enum class PictureLook : uint8_t { Material, Pieces };

enum class FaceKind : uint8_t { Outer, Inner, Crack };

/// Plain: the body's own colour and gloss.
enum class Finish : uint8_t {
    Plain,
    Floor,
    Porcelain,
    Brick,
    Concrete,
    Glass,
    Steel,
    Aluminium,
    Copper,
    Wood,
    Cloth,
    Rubber
};
Finish finish_of(const std::string& material);

/// A place of a body, as its finish sees it.
struct FinishPlace {
    Vec3 point, normal;   // body coordinates, m; the normal of its triangle
    float footprint = 0;  // m that a pixel covers; what is finer turns into its average
    FaceKind kind = FaceKind::Outer;
    bool is_model = false;  // of a thing that is smaller than real ones: its pattern is, too
};

struct FinishLook {
    Vec3 colour;           // linear share of light sent back on all sides
    Vec3 mirror{1, 1, 1};  // colour of what it mirrors: white but for metals
    float gloss = 0;       // share of the mirrored light that shows
    float facing = 0.04f;  // share mirrored when seen straight on: 0.04 glazes, 0.6 metals
    float sharpness = 64;  // of the sun's highlight: exponent of its cosine
    float spread = 0;      // of mirrored rays: 0 a clear mirror, 1 next to none
    float sheen = 0;       // light at grazing angles, of cloth
    Vec3 tilt;             // unevenness: added to the normal, body coordinates
};

/// O(1), the same on every machine. `own` is the body's colour, which Plain and Floor begin with.
FinishLook finish_at(Finish finish, const FinishPlace& place, Vec3 own, float own_gloss);

}  // namespace cullet
