#include "systems/models/thick_shell/hidden/heading.hpp"

#include <algorithm>

namespace cullet {

HeadingFan::HeadingFan(float power) {
    for (int k = 0; k <= kHeadingSteps; ++k) {
        double s, c;
        sine_cosine(k * kHeadingStep, s, c);
        sine[k] = static_cast<float>(s);
        cosine[k] = static_cast<float>(c);
        weight[k] = static_cast<float>(exponential(double{power} * logarithm(c)));
    }
}

FaceStress in_axes(const VertexStress& s, Vec3 x, Vec3 y) {
    const float ax = dot(x, s.axis_x), ay = dot(x, s.axis_y), bx = dot(y, s.axis_x), by = dot(y, s.axis_y);
    return {s.xx * ax * ax + s.yy * ay * ay + 2 * s.xy * ax * ay, s.xx * bx * bx + s.yy * by * by + 2 * s.xy * bx * by,
            s.xx * ax * bx + s.yy * ay * by + s.xy * (ax * by + ay * bx)};
}

ChosenHeading choose_heading(const HeadingFan& fan, Vec3 x, Vec3 y, const FaceStress (&face)[2],
                             const GrainLimits& grain) {
    float most = 0, best_cosine = 1, best_sine = 0;
    for (int k = 0; k <= kHeadingSteps; ++k) {
        for (const float sign : {1.0f, -1.0f}) {
            const float s = sign * fan.sine[k], c = fan.cosine[k];
            float share = 1;
            if (grain.has_grain) share = std::min(grain.tip_along, grain.tip_across) / tip_limit(grain, c * y - s * x);
            for (const FaceStress& t : face) {
                // The crack's normal is (-s, c).
                const float across = s * s * t.xx + c * c * t.yy - 2 * s * c * t.xy;
                const float value = across * fan.weight[k] * share;
                if (!(value > most)) continue;
                most = value, best_cosine = c, best_sine = s;
            }
        }
    }
    if (!(most > 0)) return {};
    return {normalised(best_cosine * x + best_sine * y), most};
}

}  // namespace cullet
