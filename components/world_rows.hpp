// What bodies of all kinds are made of, and what runs on them, whatever breaks them.
#pragma once
#include "components/body_rows.hpp"
#include "components/lattice.hpp"
#include "components/metal_rows.hpp"

namespace cullet {

/// All kinds of structures and all models. What asks them in turn takes it, and nothing else does: systems and helpers
/// of one kind or of one model take what is theirs.
struct WorldRows : SoftRows, TablesOfMetal, TablesOfSolids, TablesOfLattices {
    WorldRows(const Limits& l, const MaterialRows& of_what)
        : SoftRows(l, of_what), TablesOfMetal{l}, TablesOfSolids{l}, TablesOfLattices{l} {}

    mutable SolidWork solid_work;

    using Below = SoftRows;
    using Own = TypeList<TablesOfMetal, TablesOfSolids, TablesOfLattices>;
};

}  // namespace cullet
