// What a call of grow_cracks tells.
#pragma once
#include "components/shell_rows.hpp"

namespace cullet {

enum class CrackEventKind : uint8_t { Start, Advance };

/// A crack started at this vertex, or a tip there moved on.
struct CrackEvent {
    CrackEventKind kind;
    uint32_t vertex;  // of the task's shell
    Vec3 place;       // body frame, m
    float stress;     // Pa, the value that passed its limit
};

struct CrackSink {
    static constexpr uint32_t kMost = 128;
    CrackEvent event[kMost];
    uint32_t count = 0;
    uint32_t dropped = 0;  // events beyond kMost; their cracks are cut all the same
    uint32_t cut_edges = 0;
    uint32_t starts = 0;
    uint32_t inserted = 0;         // vertices put on edges
    uint32_t refused = 0;          // cuts and insertions that the shell had no room for: raise its spare rows
    bool is_at_border = false;     // a crack wants to start or go on by the border of a cut-out, and did not
    bool is_out_of_slots = false;  // stiffness rows could not be rebuilt: drop the task, its shell must not be stepped

    void add(const CrackEvent& e) {
        if (count < kMost)
            event[count++] = e;
        else
            ++dropped;
    }
};

}  // namespace cullet
