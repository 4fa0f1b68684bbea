#include "systems/models.hpp"
#include "systems/models/thick_shell/model.hpp"
#include "systems/structures/shell/structure.hpp"

namespace cullet {

Tenants tenants() {
    return {{thick_shell_model()}, {shell_structure()}};
}

}  // namespace cullet
