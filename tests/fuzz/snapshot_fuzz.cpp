// Reads anything as a snapshot; a world that accepts it goes on for two steps and is saved again.
#include <algorithm>
#include <cstring>

#include "engine/checksum.hpp"
#include "engine/file_header.hpp"
#include "systems/api/settings_bytes.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/fuzz/small_seeds.hpp"

namespace cullet::fuzz {
namespace {

constexpr uint8_t kMagic[8] = {'c', 's', 'n', 'a', 'p', '\r', '\n', '\x1a'};

std::vector<Bytes> make_seeds() {
    World world = globes_and_ball(glass_globe());
    std::vector<Bytes> seeds{value_of(world.snapshot())};
    for (int frame = 0; frame < 60 && world.report().open_hits == 0; ++frame) world.step();
    seeds.push_back(value_of(world.snapshot()));  // in the middle of a hit
    const uint32_t bodies = world.report().bodies;
    for (int frame = 0; frame < 120 && world.report().bodies == bodies; ++frame) world.step();
    for (int frame = 0; frame < 3; ++frame) world.step();
    seeds.push_back(value_of(world.snapshot()));  // in pieces
    World hosted = hosted_globes();
    if (const Result<void> stepped = hosted.step(HostFrame{}); !stepped) give_up(stepped.error());
    seeds.push_back(value_of(hosted.snapshot()));
    // Metal: before, while the hit is worked off, dented. Inputs name a seed by its place: new ones stand behind.
    World metal = globes_and_ball(steel_globe());
    seeds.push_back(value_of(metal.snapshot()));
    for (int frame = 0; frame < 60 && metal.report().open_hits == 0; ++frame) metal.step();
    seeds.push_back(value_of(metal.snapshot()));
    for (int frame = 0; frame < 5; ++frame) metal.step();
    seeds.push_back(value_of(metal.snapshot()));
    return seeds;
}

bool read(std::span<const uint8_t> file) {
    if (!has_small_snapshots(file)) return false;
    const bool is_hosted = file.size() > kFileHeaderBytes && file[kFileHeaderBytes] != 0;
    World world = value_of(is_hosted ? World::create_hosted(small_settings(), frugal_host())
                                     : World::create(small_settings(), frugal_host()));
    if (!world.restore(file.data(), file.size())) return false;
    for (int frame = 0; frame < 2; ++frame)
        if (is_hosted)
            (void)world.step(HostFrame{});
        else
            world.step();
    (void)world.snapshot();
    return true;
}

}  // namespace

void seal_file(Bytes& file, bool is_resized) {
    if (file.size() < kFileHeaderBytes) return;
    const auto put = [&](size_t place, const auto& value) { std::memcpy(file.data() + place, &value, sizeof value); };
    if (is_resized) put(16, uint64_t{file.size() - kFileHeaderBytes});
    put(32, checksum_of(std::span<const uint8_t>(file).subspan(kFileHeaderBytes)));
    put(48, checksum_of(std::span<const uint8_t>(file).first(48)));
}

bool has_small_settings(std::span<const uint8_t> file, size_t place) {
    if (place > file.size()) return true;
    ByteReader in(file.subspan(place), "fuzz", "");
    const Settings wanted = take_settings(in), usual = small_settings();
    if (!in.is_sound()) return true;  // refused before anything is made of it
    const LimitSettings &w = wanted.limits, &u = usual.limits;
    return w.bodies <= 4 * u.bodies && w.models <= 4 * u.models && w.vertices <= 4 * u.vertices &&
           w.elements <= 4 * u.elements && w.open_hits <= 4 * u.open_hits && w.view_vertices <= 4 * u.view_vertices &&
           w.debris <= 4 * u.debris && w.queued_hits <= 4 * u.queued_hits &&
           wanted.units_a_frame <= 4 * usual.units_a_frame;
}

bool has_small_snapshots(std::span<const uint8_t> file) {
    for (auto at = file.begin();; ++at) {
        at = std::search(at, file.end(), std::begin(kMagic), std::end(kMagic));
        if (at == file.end()) return true;
        const auto place = static_cast<size_t>(at - file.begin()) + kFileHeaderBytes + 1;  // who moves the bodies
        if (!has_small_settings(file, place)) return false;
    }
}

const Format snapshot{"snapshot", make_seeds, seal_file, read};

}  // namespace cullet::fuzz
