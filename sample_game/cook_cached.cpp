#include "sample_game/cook_cached.hpp"

#include <fmt/format.h>

#include <bit>
#include <filesystem>

#include "cullet/version.hpp"
#include "engine/checksum.hpp"
#include "engine/mesh_file.hpp"
#include "sample_game/cache.hpp"
#include "sample_game/props.hpp"

namespace cullet {
namespace {

constexpr uint64_t kLargestProgram = 1ull << 30;  // bytes

std::string hex_of(std::span<const uint8_t> bytes) {
    const Checksum sum = checksum_of(bytes);
    return fmt::format("{:016x}{:016x}", sum.high, sum.low);
}

Result<std::string> name_of_entry(const Mesh& mesh, const CookSettings& s) {
    const Result<std::vector<uint8_t>> program = read_whole_file("/proc/self/exe", kLargestProgram);
    if (!program.ok()) return Error{program.error()};
    const std::string made_from = fmt::format(
        "{} {} {} {} {} {:08x} {:08x} {:08x} {}", version(), hex_of(program.value()), hex_of(encode_mesh_file(mesh)),
        model_label(s), material_label(s), std::bit_cast<uint32_t>(s.thickness),
        std::bit_cast<uint32_t>(s.longest_edge), std::bit_cast<uint32_t>(s.weld_tolerance), s.seed);
    return hex_of({reinterpret_cast<const uint8_t*>(made_from.data()), made_from.size()}) + ".cmodel";
}

}  // namespace

std::string model_label(const CookSettings& settings) {
    const Result<std::string> named = damage_model_of(settings);
    const std::string model = named.ok() ? *named : settings.model;
    std::string label = model;
    for (const auto& group : cook_settings_of(model))
        for (const Setting& setting : group.list) label += fmt::format(" {}", group.get(settings, setting));
    return label;
}

std::string material_label(const CookSettings& settings) {
    static const MaterialTable compiled;
    const Result<MaterialSettings> found =
        (settings.materials ? *settings.materials : compiled).find(settings.material);
    std::string label = settings.material;
    if (!found.ok()) return label;
    label += fmt::format(" {} {}", name_of(found->kind), name_of(settings.fracture.value_or(found->fracture)));
    for (const MaterialValue& value : material_values())
        label += fmt::format(" {:08x}", std::bit_cast<uint32_t>(found.value().*value.member));
    return label + fmt::format(" {:08x} {:08x} {:08x}", std::bit_cast<uint32_t>(settings.grain.x),
                               std::bit_cast<uint32_t>(settings.grain.y), std::bit_cast<uint32_t>(settings.grain.z));
}

Result<CachedModel> cook_cached(const Mesh& mesh, const CookSettings& settings, const std::string& folder) {
    CachedModel result;
    std::string entry;
    if (!folder.empty()) {
        const Result<std::string> name = name_of_entry(mesh, settings);
        if (name.ok()) entry = (std::filesystem::path(folder) / name.value()).string();
        if (!name.ok()) result.trouble = name.error();
    }
    if (!entry.empty()) {
        Result<Model> kept = read_model(entry, settings.host);
        if (kept.ok()) {
            touch_entry(entry);
            result.model = std::move(kept).value();
            result.is_from_cache = true;
            return result;
        }
    }
    Result<Model> cooked = cook(view_of(mesh), settings);
    if (!cooked.ok()) return Error{cooked.error()};
    result.model = std::move(cooked).value();
    if (entry.empty()) return result;
    if (const Result<void> written = write_model(result.model, entry); !written.ok()) result.trouble = written.error();
    trim_cache(folder);
    return result;
}

}  // namespace cullet
