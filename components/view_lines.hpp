// Hairlines: cracks of a body that have not parted it, as lines of its drawn mesh.
#pragma once
#include "components/bodies.hpp"

namespace cullet {

/// Rows [view_indices.first / 2, + Bodies::hairline_indices) of a body: pairs of its view vertices, a pair a line. No
/// part of a world's state: a drawn mesh gives them. An edge of a crack face has six indices there and two candidates
/// for lines here (three and one where it has one triangle), so half of the rows are enough. Rows are written in place
/// up to the limit and never appended.
struct ViewLines : Table<ViewLines> {
    using Table::Table;
    static constexpr const char* kName = "view_lines";
    Column<uint32_t> index{*this, "index", "1", Keep::Scratch};  // relative to the body's first view vertex
};

/// Row of the body's first line.
inline uint32_t first_line_row(const Bodies& bodies, Row<Bodies> body) {
    return bodies.view_indices[body].first / 2;
}

}  // namespace cullet
