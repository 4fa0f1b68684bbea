// What bodies are made of, as far as all kinds of structures are alike. What edits, copies and measures structures of
// any kind takes these tables.
#pragma once
#include "components/limits.hpp"
#include "components/materials.hpp"
#include "components/structures.hpp"
#include "engine/scratch.hpp"
#include "engine/system.hpp"

namespace cullet {

/// What things are made of. Only the game changes it.
struct MaterialRows {
    const Materials& materials;
    const MaterialTraits& material_traits;
};

inline uint32_t cell_limit(const Limits& l) {
    return l.vertices / 8;
}

/// What bodies are made of, as far as all kinds of structures are alike.
struct TablesOfStructures {
    Limits limits;
    Structures structures{limits.structures, limits.structures};
    Cells cells{cell_limit(limits), limits.structures};
    HullPoints hull_points{cell_limit(limits) * 32, limits.structures};
};
struct StructureRows : MaterialRows, TablesOfStructures {
    StructureRows(const Limits& l, const MaterialRows& of_what) : MaterialRows(of_what), TablesOfStructures{l} {}

    mutable ScratchMemory scratch;  // of functions that need more than a stack holds

    using Below = MaterialRows;
    using Own = TablesOfStructures;
};

/// Structures with the convex pieces that collide for them.
using ConvexCells = Tables<Structures, Cells, HullPoints>;

inline bool is_shell(const Structures& structures, Row<Structures> structure) {
    return structures.kind[structure] == static_cast<uint8_t>(StructureKind::Shell);
}

}  // namespace cullet
