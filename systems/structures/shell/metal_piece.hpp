// Rows of metal of a piece that comes off a metal shell: it dents and tears again.
#pragma once
#include "components/metal_rows.hpp"

namespace cullet {

/// Rows for a piece of so many vertices and elements, whose springs are these of the broken shell's. False: there is no
/// room (`full` then names the limit). What is of no metal needs none.
bool reserve_metal(MetalTables rows, Row<Structures> broken, Row<Structures> piece, const MetalRoom& room,
                   const char** full);

/// When the shell's own rows are filled: Vertices.copy and Elements.copy of the broken shell's rows say which row of
/// the piece each became, and Vertices.copy of the piece's which it was. Sub-shells that it has nothing of are left
/// out.
struct MetalPart {
    uint32_t first_element = kNone;  // of the broken shell's, the others by Elements.next
    uint32_t vertices = 0;           // of the piece, without those that fill its last pack
};
void fill_metal(MetalShellRows rows, Row<Structures> broken, Row<Structures> piece, const MetalPart& part);

}  // namespace cullet
