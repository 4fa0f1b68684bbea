#include "systems/drawn/query_index.hpp"
#include "systems/systems.hpp"

namespace cullet {

void refresh_queries(Serial, const Bodies& bodies, QueryIndex& index) {
    index.refresh(bodies);
}

}  // namespace cullet
