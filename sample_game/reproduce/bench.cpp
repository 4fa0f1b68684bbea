#include "sample_game/reproduce/bench.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>

#include "sample_game/import_model.hpp"
#include "sample_game/props.hpp"

namespace cullet::reproduce {

const char* name_of(Verdict verdict) {
    switch (verdict) {
        case Verdict::Met:
            return "met";
        case Verdict::FallsShort:
            return "falls short";
        case Verdict::Shown:
            return "shown";
        case Verdict::NotMeasured:
            break;
    }
    return "not measured";
}

double seconds_now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Bench::Bench(Settings settings) : settings_(std::move(settings)), shelf_(std::make_shared<ModelShelf>()) {}

uint32_t Bench::threads() const {
    return settings_.threads > 0 ? settings_.threads : std::max(1u, std::thread::hardware_concurrency());
}

void Bench::note(std::string sentence) {
    if (std::find(notes_.begin(), notes_.end(), sentence) == notes_.end()) notes_.push_back(std::move(sentence));
}

std::optional<Mesh> Bench::strangers_mesh(const std::string& path, float size) {
    const std::string key = fmt::format("{} {}", path, size);
    if (const auto known = meshes_.find(key); known != meshes_.end()) return known->second;
    std::optional<Mesh>& mesh = meshes_[key];
    const std::filesystem::path file = std::filesystem::path(settings_.data) / path;
    std::error_code error;
    if (settings_.data.empty() || !std::filesystem::exists(file, error)) {
        note(path + " is not in the folder of test data: its rows are left out.");
        return mesh;
    }
    Result<Mesh> read = import_model(file.string());
    if (!read.ok()) {
        note(fmt::format("{} could not be read: its rows are left out.", path));
        return mesh;
    }
    if (fit(*read, size)) {
        const float low = extent_of(*read).low.y;  // before the mesh moves on: arguments have no order
        mesh = moved(std::move(*read), {0, -low, 0});
    }
    return mesh;
}

Result<void> Bench::add_picture(Claim& claim, const Picture& picture, const std::string& name,
                                const std::string& caption) {
    const std::string file = claim.id + "_" + name + ".png";
    if (auto written = write_png(picture, settings_.out + "/" + file); !written.ok()) return written;
    claim.pictures.push_back({file, caption});
    return {};
}

Result<void> Bench::add_pictures(Claim& claim, std::span<const Picture> pictures, const std::string& name,
                                 std::vector<std::string> captions) {
    std::string caption;
    for (size_t n = 0; n < pictures.size(); ++n) {
        if (n < captions.size() && !captions[n].empty()) caption = captions[n];
        if (auto added = add_picture(claim, pictures[n], fmt::format("{}{}", name, n + 1), caption); !added.ok())
            return added;
    }
    return {};
}

}  // namespace cullet::reproduce
