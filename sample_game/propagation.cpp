#include "sample_game/propagation.hpp"

#include "sample_game/model_settings.hpp"

namespace cullet {

std::string name_of(Propagation way) {
    CookSettings settings;
    settings.thick_shell.propagation = way;
    for (const auto& group : all_cook_settings())
        for (const Setting& setting : group.list)
            if (std::string(setting.name) == "propagation") return text_of(setting, group.get(settings, setting));
    return "";
}

}  // namespace cullet
