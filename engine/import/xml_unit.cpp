#include "engine/import/xml_unit.hpp"

#include <vector>

#include "engine/import/words.hpp"
#include "engine/import/xml.hpp"
#include "engine/mesh_file.hpp"

namespace cullet {
namespace {

struct PlacesListener : XmlListener {
    std::optional<double> metres;
    std::string named;  // the unit as it stands there
    uint64_t turned = 0;
    struct Bytes {
        size_t first, end;
    };
    std::vector<Bytes> turns;  // of the file

    void begin(std::string_view name, Attributes attributes) override {
        const std::string_view local = without_prefix(name);
        if (is_word(local, "instance")) is_instance_ = true, is_turned_ = false;
        if (is_instance_ && is_turn(local)) turns.push_back({first_byte(), first_byte()}), angle_.clear();
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
    void text(std::string_view piece) override { angle_ += piece; }
    void end(std::string_view name) override {
        const std::string_view local = without_prefix(name);
        if (is_instance_ && is_turn(local)) {
            turns.back().end = first_byte() + byte_count();
            const std::string_view angle = Words(angle_).peek();
            is_turned_ = is_turned_ || (!angle.empty() && number_of(angle) != 0.0);
        }
        if (!is_word(local, "instance")) return;
        turned += is_turned_;
        is_instance_ = is_turned_ = false;
    }

 private:
    static bool is_turn(std::string_view local) {
        return is_word(local, "rx") || is_word(local, "ry") || is_word(local, "rz");
    }

    std::string angle_;
    bool is_instance_ = false, is_turned_ = false;
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

Result<XmlPlaces> places_of_xml(std::string& text, const std::string& path) {
    PlacesListener listener;
    if (auto r = read_xml(text, listener, path); !r) return Error{r.error()};
    if (!listener.metres && !listener.named.empty())
        return Error{path + ": its unit is \"" + one_line(listener.named, 40) +
                     "\", which is no length. Repair the file or export it again."};
    for (const auto& turn : listener.turns) text.replace(turn.first, turn.end - turn.first, turn.end - turn.first, ' ');
    return XmlPlaces{listener.metres.value_or(1), listener.turned};
}

}  // namespace cullet
