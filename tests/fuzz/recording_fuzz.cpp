// Replays anything as a recording, for three steps.
#include <unistd.h>

#include <cstring>
#include <filesystem>

#include "engine/hash.hpp"
#include "engine/mesh_file.hpp"
#include "systems/api/replay.hpp"
#include "systems/api/with_models.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/fuzz/small_seeds.hpp"

namespace cullet::fuzz {
namespace {

constexpr size_t kHead = 16, kChunkHead = 8, kChain = 8;  // bytes, see recording_file.hpp

uint32_t number_at(const Bytes& file, size_t place) {
    uint32_t value = 0;
    std::memcpy(&value, file.data() + place, sizeof value);
    return value;
}

void seal(Bytes& file, bool) {
    uint64_t chain = 0;
    for (size_t at = kHead; at + kChunkHead <= file.size();) {
        const size_t size = number_at(file, at + 4);
        if (size > file.size() - at - kChunkHead || file.size() - at - kChunkHead - size < kChain) return;
        const uint32_t head[2] = {number_at(file, at), static_cast<uint32_t>(size)};
        chain = hash_bytes(file.data() + at + kChunkHead, size, hash_bytes(head, sizeof head, chain));
        at += kChunkHead + size;
        std::memcpy(file.data() + at, &chain, sizeof chain);
        at += kChain;
    }
}

/// Where the settings of the first chunk stand: behind the text of the build and two flags.
size_t settings_place(const Bytes& file) {
    return kHead + kChunkHead + 4 + size_t{number_at(file, kHead + kChunkHead)} + 2;
}

/// The name of the build that recorded goes, so that places in the file are the same in every build.
void forget_build(Bytes& file) {
    const size_t text = kHead + kChunkHead;
    const uint32_t length = number_at(file, text), size = number_at(file, kHead + 4) - length, none = 0;
    file.erase(file.begin() + text + 4, file.begin() + static_cast<ptrdiff_t>(text + 4 + length));
    std::memcpy(file.data() + text, &none, sizeof none);
    std::memcpy(file.data() + kHead + 4, &size, sizeof size);
    seal(file, true);
}

template <class Play>
Bytes recorded(World world, Play play) {
    const auto path = std::filesystem::temp_directory_path() / ("cullet_fuzz." + std::to_string(getpid()) + ".rec");
    if (const Result<void> begun = world.start_recording(path.string()); !begun) give_up(begun.error());
    play(world);
    if (const Result<void> ended = world.stop_recording(); !ended) give_up(ended.error());
    Bytes file = value_of(read_whole_file(path.string(), 1u << 24));
    std::filesystem::remove(path);
    std::filesystem::remove_all(path.string() + ".models");
    forget_build(file);
    return file;
}

/// Every call that needs no model.
void ask_for_all(World& world) {
    const Vec3 corners[] = {{-5, 0, -5}, {-5, 0, 5}, {5, 0, 5}, {5, 0, -5}};
    const uint32_t quad[] = {0, 1, 2, 0, 2, 3};
    const BodyId floor = value_of(world.add_static({corners, 4, quad, 2}));
    SphereSettings ball;
    ball.pose.position = {0, 0.2f, 0};
    const BodyId first = value_of(world.add_sphere(ball));
    ball.pose.position = {1, 0.2f, 0};
    const BodyId second = value_of(world.add_sphere(ball));
    KinematicSettings box;
    box.pose.position = {2, 0, 0};
    const BodyId lift = value_of(world.add_kinematic_box(box));
    world.step();
    (void)world.set_motion(lift, {{0, 0.5f, 0}, {}});
    (void)world.set_pose(first, {{0.5f, 1, 0}, {}});
    (void)world.wake(second);
    (void)world.set_gravity({0, -1, 0});
    world.step();
    const Bytes now = value_of(world.snapshot());
    (void)world.shift_origin({8, 0, -4});
    (void)world.remove(floor);
    world.step();
    (void)world.restore(now.data(), now.size());
    world.step();
}

/// The host tells of its bodies, and that the two globes touch.
void move_globes(World& world) {
    BodyId bodies[2];
    if (world.bodies(bodies, 2) != 2) give_up("there are not two globes");
    HostBody rows[2];
    for (int b = 0; b < 2; ++b) rows[b] = {bodies[b], {{0.199f * static_cast<float>(b), 0, 0}, {}}, {}, false};
    rows[0].motion.velocity = {15, 0, 0};
    const HostContact touch{bodies[0], bodies[1], {0.1f, 0, 0}, {-1, 0, 0}, -0.001f, 0, 0};
    for (int frame = 0; frame < 4; ++frame)
        if (const Result<void> stepped = world.step(HostFrame{rows, 2, &touch, 1}); !stepped) give_up(stepped.error());
}

std::vector<Bytes> make_seeds() {
    return {recorded(value_of(World::create(small_settings())), ask_for_all),
            recorded(globes_and_ball(glass_globe()),
                     [](World& world) {
                         for (int frame = 0; frame < 4; ++frame) world.step();
                     }),
            recorded(hosted_globes(), move_globes)};
}

bool read(std::span<const uint8_t> file) {
    const Bytes bytes(file.begin(), file.end());
    if (bytes.size() < kHead + kChunkHead + 4) return false;
    if (!has_small_settings(file, settings_place(bytes)) || !has_small_snapshots(file)) return false;
    Replayer replayer({file, "fuzz.rec", "/nowhere", &create_with}, 1, frugal_host());
    if (!replayer.begin()) return false;
    for (int frame = 0; frame < 3 && replayer.step();) ++frame;
    return true;
}

}  // namespace

const Format recording{"recording", make_seeds, seal, read};

}  // namespace cullet::fuzz
