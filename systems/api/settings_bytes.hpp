// The settings that a world's bytes hang on, as numbers in the order of the bytes, for both ways. Threads are the
// machine's affair and not among them.
#pragma once
#include "cullet/settings.hpp"
#include "engine/byte_stream.hpp"

namespace cullet {

template <class S, class F>
void for_each_setting(S& s, F&& f) {
    f(s.gravity.x), f(s.gravity.y), f(s.gravity.z);
    f(s.step_seconds), f(s.units_a_frame), f(s.hold_seconds), f(s.frames_ahead), f(s.generations), f(s.debris_share),
        f(s.debris_elements);
    f(s.break_share), f(s.break_elements);
    auto& l = s.limits;
    f(l.bodies), f(l.models), f(l.vertices), f(l.elements), f(l.open_hits), f(l.view_vertices), f(l.debris),
        f(l.queued_hits), f(l.fragments), f(l.births_a_frame);
    f(s.debris_seconds);
}

/// Settings that are good for a world; trouble stays with the reader.
Settings take_settings(ByteReader& in);

}  // namespace cullet
