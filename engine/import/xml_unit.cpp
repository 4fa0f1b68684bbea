#include "engine/import/xml_unit.hpp"

#include "engine/import/words.hpp"
#include "engine/import/xml.hpp"
#include "engine/mesh_file.hpp"

namespace cullet {
namespace {

struct UnitListener : XmlListener {
    std::optional<double> metres;
    std::string named;  // as it stands there

    void begin(std::string_view name, Attributes attributes) override {
        const std::string_view local = without_prefix(name);
        if (is_word(local, "amf")) {
            const char* const unit = attribute(attributes, "unit");
            named = unit != nullptr ? unit : "millimeter";
            metres = metres_of(small_letters(named));
        }
        const char* const category = attribute(attributes, "category");
        if (local != "unit" || category == nullptr || std::string_view(category) != "length") return;
        const char* const factor = attribute(attributes, "conversionFactor");
        named = factor != nullptr ? factor : "";
        const auto number = number_of(named);
        metres = is_length(number) ? number : std::nullopt;
    }
};

}  // namespace

std::optional<double> metres_of(std::string_view unit) {
    constexpr struct {
        std::string_view name;
        double metres;
    } kUnits[] = {{"micron", 1e-6}, {"millimeter", 1e-3}, {"centimeter", 1e-2}, {"inch", 0.0254},
                  {"foot", 0.3048}, {"feet", 0.3048},     {"meter", 1}};
    for (const auto& known : kUnits)
        if (unit == known.name) return known.metres;
    return std::nullopt;
}

bool is_length(std::optional<double> metres) {
    return metres && *metres > 0 && *metres < 1e12;
}

Result<double> unit_of_xml(std::string_view bytes, const std::string& path) {
    UnitListener listener;
    if (auto r = read_xml(bytes, listener, path); !r) return Error{r.error()};
    if (listener.metres) return *listener.metres;
    if (listener.named.empty()) return 1.0;
    return Error{path + ": its unit is \"" + one_line(listener.named, 40) +
                 "\", which is no length. Repair the file or export it again."};
}

}  // namespace cullet
