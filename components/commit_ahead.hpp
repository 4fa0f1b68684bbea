// Pages for what will break, before it does.
#pragma once
#include "components/world_rows.hpp"

namespace cullet {

/// Pages behind the rows in use: room for hits on shells of these rows and for the pieces, of at most `bytes`. Touches
/// no value.
void commit_ahead(WorldRows& rows, const ShellRoom& shell, uint64_t bytes = ~uint64_t{0});

}  // namespace cullet
