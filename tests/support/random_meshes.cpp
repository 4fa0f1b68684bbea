#include "tests/support/random_meshes.hpp"

#include "tests/support/simple_meshes.hpp"

namespace cullet::test {
namespace {

/// Numbers that follow from a seed (splitmix64).
class Numbers {
 public:
    explicit Numbers(uint64_t seed) : state_(seed) {}
    uint64_t next() {
        uint64_t z = (state_ += 0x9e3779b97f4a7c15ull);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
        return z ^ (z >> 31);
    }
    double between(double low, double high) { return low + (high - low) * static_cast<double>(next() >> 11) * 0x1p-53; }
    uint32_t whole(uint32_t low, uint32_t high) { return low + static_cast<uint32_t>(next() % (high - low + 1)); }

 private:
    uint64_t state_;
};

Mesh random_cup(Numbers& numbers) {
    const float wall = static_cast<float>(numbers.between(0.03, 0.2)),
                high = static_cast<float>(numbers.between(0.3, 1.5));
    const uint32_t steps = numbers.whole(4, 9);
    std::vector<Vec2> profile{{0, 0}};
    const auto line = [&](Vec2 to) {
        const Vec2 from = profile.back();
        for (uint32_t k = 1; k <= steps; ++k) {
            const float share = static_cast<float>(k) / static_cast<float>(steps);
            profile.push_back({from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)});
        }
    };
    line({1, 0}), line({1, high});
    profile.push_back({1 - wall, high});
    line({1 - wall, wall}), line({0, wall});
    return lathe_mesh(profile, numbers.whole(12, 20));
}

Mesh random_shape(Numbers& numbers) {
    switch (numbers.whole(0, 7)) {
        case 0:
            return sphere_mesh(1, 2);
        case 1:
            return box_mesh({1, numbers.between(0.3, 1), numbers.between(0.3, 1)}, numbers.whole(4, 9));
        case 2:
            return torus_mesh(1, numbers.between(0.15, 0.4), numbers.whole(16, 36), numbers.whole(8, 16));
        case 3:
            return torus_mesh(1, numbers.between(0.03, 0.1), numbers.whole(30, 60), numbers.whole(5, 9));
        case 4: {
            const double amplitude = numbers.between(0.02, 0.25), waves = numbers.between(6, 40);
            return sheet_mesh(1, 1, numbers.whole(30, 80), numbers.whole(3, 8),
                              [=](double x, double) { return amplitude * std::sin(waves * x); });
        }
        case 5:
            return box_mesh({1, 1, numbers.between(0.02, 0.1)}, numbers.whole(4, 9));
        case 6: {
            Mesh mesh = sphere_mesh(1, 2);
            append(mesh, turned_inside_out(sphere_mesh(numbers.between(0.3, 0.9), 2)));
            return mesh;
        }
        default:
            return random_cup(numbers);
    }
}

}  // namespace

Mesh random_mesh(uint64_t seed) {
    Numbers numbers(seed);
    Mesh mesh = random_shape(numbers);
    double edges = 0;
    for (const auto& t : mesh.triangles) edges += double{length(mesh.positions[t[1]] - mesh.positions[t[0]])};
    const double noise = numbers.between(0, 0.04) * edges / static_cast<double>(mesh.triangles.size());
    for (Vec3& p : mesh.positions) {
        const Vec3d moved =
            Vec3d(p) + noise * Vec3d(numbers.between(-1, 1), numbers.between(-1, 1), numbers.between(-1, 1));
        p = moved.to_float();
    }
    Mesh renumbered = shuffled(mesh, numbers.next());
    renumbered.name = mesh.name;
    return renumbered;
}

}  // namespace cullet::test
