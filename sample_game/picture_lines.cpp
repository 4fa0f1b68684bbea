#include "sample_game/picture_lines.hpp"

#include <algorithm>

namespace cullet {

namespace {

constexpr float kBell = 0.55f, kReach = 1.7f;  // pixels
constexpr float kNear = 1e-3f;                 // m; what is nearer to the eye is not drawn
constexpr float kLeastSlope = 0.15f;

/// A point on the picture, in pixels from the upper left corner, and how far off it is.
struct OnPicture {
    float x, y, depth;  // depth in m along the middle ray
};

OnPicture project(const PictureFrame& frame, Vec3 p) {
    const Vec3 from_eye = p - frame.eye;
    const float depth = dot(from_eye, frame.forward);
    const float height = static_cast<float>(frame.height), width = static_cast<float>(frame.width);
    const float across = dot(from_eye, frame.right) / (dot(frame.right, frame.right) * depth);
    const float upwards = dot(from_eye, frame.up) / (dot(frame.up, frame.up) * depth);
    return {0.5f * (across * height + width), 0.5f * (1 - upwards) * height, depth};
}

/// A pixel is as wide as this at distance 1.
float pixel_width(const PictureFrame& frame) {
    return 2 * length(frame.up) / static_cast<float>(frame.height);
}

bool is_seen(const PixelFace& face, uint32_t body, FaceKind kind, bool is_glass, float distance, float width) {
    // Two pixels aside a slanted face is that much nearer.
    const float reach = face.distance + 2e-4f + 2 * kReach * width * distance / std::max(kLeastSlope, face.slope);
    if (distance > reach) return false;
    return is_glass ? face.front == body : face.front == body && face.body == body && face.kind == kind;
}

}  // namespace

std::vector<float> hairline_ink(std::span<const DrawnBody> bodies, const PictureFrame& frame,
                                std::span<const PixelFace> faces) {
    std::vector<float> ink(faces.size());
    const float width = pixel_width(frame);
    const auto clamped = [](float low, float high, uint32_t size) {
        const float most = static_cast<float>(size);
        return std::pair(static_cast<uint32_t>(std::clamp(std::floor(low), 0.0f, most)),
                         static_cast<uint32_t>(std::clamp(std::ceil(high), 0.0f, most)));
    };
    for (uint32_t b = 0; b < bodies.size(); ++b) {
        const Mat3 turn = matrix(bodies[b].pose.orientation);
        for (const DrawnLine& line : bodies[b].lines) {
            const Vec3 from = turn * line.from + bodies[b].pose.position, to = turn * line.to + bodies[b].pose.position;
            const OnPicture p = project(frame, from), q = project(frame, to);
            if (!(p.depth > kNear && q.depth > kNear)) continue;
            const float dx = q.x - p.x, dy = q.y - p.y, squared = std::max(1e-12f, dx * dx + dy * dy);
            const auto [left, right] = clamped(std::min(p.x, q.x) - 2, std::max(p.x, q.x) + 2, frame.width);
            const auto [top, bottom] = clamped(std::min(p.y, q.y) - 2, std::max(p.y, q.y) + 2, frame.height);
            for (uint32_t y = top; y < bottom; ++y)
                for (uint32_t x = left; x < right; ++x) {
                    const float away_x = static_cast<float>(x) + 0.5f - p.x,
                                away_y = static_cast<float>(y) + 0.5f - p.y;
                    const float t = std::clamp((away_x * dx + away_y * dy) / squared, 0.0f, 1.0f);
                    const float off_x = away_x - t * dx, off_y = away_y - t * dy;
                    const float off = off_x * off_x + off_y * off_y;
                    if (off > kReach * kReach) continue;
                    // Evenly along the picture is not evenly along the line: 1 / depth is.
                    const float along = t * p.depth / ((1 - t) * q.depth + t * p.depth);
                    const float distance = length(from + along * (to - from) - frame.eye);
                    const size_t pixel = size_t{y} * frame.width + x;
                    if (!is_seen(faces[pixel], b, line.kind, bodies[b].opacity < 1, distance, width)) continue;
                    const double bell = exponential(-static_cast<double>(off) / (2 * double{kBell} * double{kBell}));
                    ink[pixel] = std::max(ink[pixel], static_cast<float>(bell));
                }
        }
    }
    return ink;
}

}  // namespace cullet
