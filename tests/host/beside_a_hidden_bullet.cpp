// A host whose own Bullet, of double precision, keeps to itself: both work. argv[1]: the part that has it.
#include <dlfcn.h>

#include <cmath>
#include <cstdio>

#include "cullet/world.hpp"

using namespace cullet;

int main(int, char** argv) {
    void* const part = dlopen(argv[1], RTLD_NOW | RTLD_LOCAL | RTLD_DEEPBIND);
    if (!part) return std::puts(dlerror()), 1;
    const auto box = reinterpret_cast<double (*)()>(dlsym(part, "height_of_a_box_at_rest"));
    const double before = box();
    Result<World> world = World::create({});
    if (!world) return std::puts(world.error().c_str()), 1;
    const Vec3 corners[] = {{-20, 0, -20}, {-20, 0, 20}, {20, 0, 20}, {20, 0, -20}};
    const uint32_t quad[] = {0, 1, 2, 0, 2, 3};
    (void)world->add_static({corners, 4, quad, 2});
    SphereSettings sphere;
    sphere.pose.position = {0, 1, 0};
    const BodyId ball = world->add_sphere(sphere).value();
    for (int step = 0; step < 120; ++step) world->step();
    const double rests = static_cast<double>(world->pose(ball)->position.y), after = box();
    std::printf("the host's box rests at %.3f and %.3f, cullet's ball at %.3f; 0.1 each\n", before, after, rests);
    const auto is_right = [](double height) { return std::fabs(height - 0.1) < 0.01; };
    return is_right(before) && is_right(after) && is_right(rests) ? 0 : 1;
}
