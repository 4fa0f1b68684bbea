#include "sample_game/picture.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <thread>
#include <vector>

namespace cullet {
namespace {

struct Shape {
    std::vector<Vec3> positions, normals;
    std::vector<uint32_t> indices;
    DrawnBody body() const {
        DrawnBody body;
        body.positions = positions, body.normals = normals, body.indices = indices;
        body.colour = {0.5f, 0.5f, 0.5f};
        body.gloss = 0;
        return body;
    }
};

// Unit sphere about the origin by rings and sectors.
Shape sphere(uint32_t rings, uint32_t sectors) {
    Shape shape;
    for (uint32_t r = 0; r <= rings; ++r) {
        for (uint32_t s = 0; s <= sectors; ++s) {
            double ring_sine, ring_cosine, sine, cosine;
            sine_cosine(3.141592653589793 * r / rings, ring_sine, ring_cosine);
            sine_cosine(6.283185307179586 * s / sectors, sine, cosine);
            shape.positions.push_back(Vec3d{ring_sine * cosine, ring_cosine, -ring_sine * sine}.to_float());
        }
    }
    shape.normals = shape.positions;
    for (uint32_t r = 0; r < rings; ++r) {
        for (uint32_t s = 0; s < sectors; ++s) {
            const uint32_t a = r * (sectors + 1) + s, b = a + sectors + 1;
            for (const uint32_t corner : {a, b, b + 1, a, b + 1, a + 1}) shape.indices.push_back(corner);
        }
    }
    return shape;
}

// A square of side 2 in the plane z = 0, its face towards +z.
Shape square() {
    return {{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {}, {0, 1, 2, 0, 2, 3}};
}

PictureSettings small() {
    PictureSettings settings;
    settings.width = 192, settings.height = 108;
    settings.grid_spacing = 1000;  // no lines in the way
    return settings;
}

// Straight along -z; at z = 0 the picture is 2 * reach high.
Camera front(float reach) {
    return {{0, 0, 10}, {0, 0, 0}, 2 * reach / 10};
}

float light_at(const Picture& picture, uint32_t x, uint32_t y) {
    const uint8_t* rgb = picture.pixel(x, y);
    return (linear_from_srgb(rgb[0]) + linear_from_srgb(rgb[1]) + linear_from_srgb(rgb[2])) / 3;
}

TEST(Picture, ASphereOnTheGroundIsDarkAwayFromTheSunAndShadesTheGroundThere) {
    const Shape shape = sphere(32, 64);
    DrawnBody body = shape.body();
    body.pose.position = {0, 1, 0};
    Sun sun;
    sun.towards = {1, 1, 0};
    const Camera camera{{0, 6, 12}, {0, 0.5f, 0}, 0.5f};
    const Picture picture = draw(std::span(&body, 1), camera, sun, small());
    EXPECT_GT(light_at(picture, 106, 45), 2.5f * light_at(picture, 85, 50));  // about 15 pixels a metre
    EXPECT_GT(light_at(picture, 150, 60), 2 * light_at(picture, 70, 58));
    EXPECT_NEAR(light_at(picture, 150, 60), light_at(picture, 20, 60), 0.05f);
}

TEST(Picture, IsTheSameTwiceAndWithTwoThreads) {
    const Shape shape = sphere(16, 32);
    DrawnBody bodies[2] = {shape.body(), shape.body()};
    bodies[0].pose.position = {-0.6f, 1, 0};
    bodies[1].pose.position = {0.9f, 1, 0.5f};
    bodies[1].opacity = 0.3f;
    const Camera camera{{0, 3, 9}, {0, 0.5f, 0}, 0.5f};
    PictureSettings settings = small();
    const Picture once = draw(bodies, camera, Sun{}, settings);
    EXPECT_EQ(draw(bodies, camera, Sun{}, settings).rgb, once.rgb);
    settings.for_each = [](uint32_t count, const std::function<void(uint32_t)>& job) {
        std::atomic<uint32_t> next{0};
        const auto work = [&] {
            for (uint32_t j; (j = next++) < count;) job(j);
        };
        std::thread other(work);
        work();
        other.join();
    };
    EXPECT_EQ(draw(bodies, camera, Sun{}, settings).rgb, once.rgb);
}

TEST(Picture, ACoarseSmoothSphereIsAsBrightAsTheCosineSaysWithoutShadowsOfItsFacets) {
    const Shape shape = sphere(10, 16);
    const DrawnBody body = shape.body();
    PictureSettings settings = small();
    settings.has_ground = false;
    Sun sun;
    sun.towards = {1, 0, 0};
    const Picture picture = draw(std::span(&body, 1), front(1.2f), sun, settings);
    int compared = 0;
    for (uint32_t y = 0; y < settings.height; ++y) {
        for (uint32_t x = 0; x < settings.width; ++x) {
            const float scale = 2.4f / static_cast<float>(settings.height);
            const float along = (static_cast<float>(x) + 0.5f - 96) * scale, up = (54 - static_cast<float>(y)) * scale;
            if (along < 0.2f || along * along + up * up > 0.75f) continue;
            ++compared;
            EXPECT_GT(light_at(picture, x, y), 0.8f * settings.exposure * 0.5f * sun.strength * 0.94f * along)
                << x << ' ' << y;
        }
    }
    EXPECT_GT(compared, 1000);
}

TEST(Picture, CrackFacesAreDarkerThanOuterOnesAndInnerOnesGreyer) {
    const Shape shape = square();
    DrawnBody body = shape.body();
    body.colour = {0.6f, 0.2f, 0.1f};
    const DrawnRun runs[1] = {{0, 6, FaceKind::Crack}}, inner[1] = {{0, 6, FaceKind::Inner}};
    const Picture outer = draw(std::span(&body, 1), front(0.5f), Sun{}, small());
    body.runs = runs;
    const Picture crack = draw(std::span(&body, 1), front(0.5f), Sun{}, small());
    body.runs = inner;
    const Picture faded = draw(std::span(&body, 1), front(0.5f), Sun{}, small());
    EXPECT_LT(light_at(crack, 96, 54), 0.75f * light_at(outer, 96, 54));
    EXPECT_LT(faded.pixel(96, 54)[0] - faded.pixel(96, 54)[2], outer.pixel(96, 54)[0] - outer.pixel(96, 54)[2]);
}

TEST(Picture, GlassLetsThroughWhatStandsBehindIt) {
    const Shape shape = square();
    DrawnBody bodies[2] = {shape.body(), shape.body()};
    bodies[0].colour = {0.8f, 0.05f, 0.05f};
    bodies[1].colour = {0.05f, 0.05f, 0.8f};
    bodies[1].pose.position = {0, 0, 1};
    bodies[1].opacity = 0.3f;
    const Picture both = draw(bodies, front(0.5f), Sun{}, small());
    const Picture without = draw(std::span(bodies, 1), front(0.5f), Sun{}, small());
    const uint8_t* rgb = both.pixel(96, 54);
    EXPECT_GT(rgb[0], 100);
    EXPECT_LT(rgb[0], without.pixel(96, 54)[0]);
    EXPECT_GT(rgb[2], without.pixel(96, 54)[2]);
}

// Ink: darkness summed across the line, in pixels.
float ink_between(std::span<const DrawnBody> bodies, float shift) {
    Camera camera = front(0.5f);
    camera.eye.x = camera.target.x = shift / 108;  // pixels to metres
    const Picture picture = draw(bodies, camera, Sun{}, small());
    float ink = 0;
    for (uint32_t x = 86; x < 106; ++x) ink += 1 - light_at(picture, x, 54) / light_at(picture, 80, 54);
    return ink;
}

// Each of the finishes, on any number of threads alike; what is broken shows another colour.
TEST(Picture, FinishesAreDrawnTheSameInAnyOrderOfRows) {
    for (const Finish finish : {Finish::Porcelain, Finish::Brick, Finish::Glass, Finish::Steel, Finish::Cloth}) {
        const Shape ball = sphere(16, 32);
        DrawnBody body = ball.body();
        body.finish = finish;
        body.opacity = finish == Finish::Glass ? 0.4f : 1;
        PictureSettings settings = small();
        settings.has_finishes = true;
        const Picture once = draw(std::span(&body, 1), front(1.2f), Sun{}, settings);
        settings.for_each = [](uint32_t count, const std::function<void(uint32_t)>& job) {
            for (uint32_t i = count; i-- > 0;) job(i);
        };
        EXPECT_EQ(draw(std::span(&body, 1), front(1.2f), Sun{}, settings).rgb, once.rgb);
        const DrawnRun broken{0, static_cast<uint32_t>(body.indices.size()), FaceKind::Crack};
        body.runs = std::span(&broken, 1);
        EXPECT_NE(draw(std::span(&body, 1), front(1.2f), Sun{}, settings).rgb, once.rgb);
    }
}

TEST(Picture, ALineOfTheSameInkSeparatesTwoBodiesOfOneColourUnlessNeitherIsOutlined) {
    const Shape shape = square();
    DrawnBody bodies[2] = {shape.body(), shape.body()};
    bodies[0].pose.position = {-1, 0, 0};
    bodies[1].pose.position = {1, 0, 0};
    for (const float shift : {0.01f, 0.26f, 0.51f, 0.76f})
        EXPECT_NEAR(ink_between(bodies, shift), 1.15f, 0.2f) << shift;
    bodies[0].is_outlined = bodies[1].is_outlined = false;
    EXPECT_NEAR(ink_between(bodies, 0.01f), 0, 0.1f);
}

TEST(Picture, AnEmptyWorldShowsSkyOverGroundAndAPictureOfNoPixelsIsEmpty) {
    const Picture picture = draw({}, Camera{{0, 1, 3}, {0, 1, 0}, 0.6f}, Sun{}, small());
    EXPECT_GT(picture.pixel(96, 10)[2], picture.pixel(96, 10)[0]);        // blue above
    EXPECT_LT(picture.pixel(96, 100)[2] - picture.pixel(96, 100)[0], 8);  // grey below
    PictureSettings none;
    none.width = 0;
    EXPECT_TRUE(draw({}, Camera{}, Sun{}, none).rgb.empty());
}

TEST(Picture, TrianglesWithMissingPositionsAreLeftOut) {
    Shape shape = square();
    const DrawnBody good = shape.body();
    const Picture expected = draw(std::span(&good, 1), front(2), Sun{}, small());
    Shape broken = shape;
    for (const uint32_t corner : {0u, 1u, 4000000000u}) broken.indices.push_back(corner);
    const DrawnRun runs[2] = {{6, 3000, FaceKind::Outer}, {4000000000u, 3, FaceKind::Crack}};
    DrawnBody body = broken.body();
    body.runs = runs;
    EXPECT_EQ(draw(std::span(&body, 1), front(2), Sun{}, small()).rgb, expected.rgb);
}

class TemporaryFile {
 public:
    explicit TemporaryFile(const char* name) : path(testing::TempDir() + name) {}
    ~TemporaryFile() { std::remove(path.c_str()); }
    const std::string path;
};

TEST(Png, APictureComesBackFromItsFile) {
    const TemporaryFile file("cullet_picture_test.png");
    Picture picture = blank_picture(37, 21);
    for (size_t k = 0; k < picture.rgb.size(); ++k) picture.rgb[k] = static_cast<uint8_t>(k * k + 7 * k);
    ASSERT_TRUE(write_png(picture, file.path));
    const Result<Picture> read = read_png(file.path);
    ASSERT_TRUE(read.ok()) << read.error();
    EXPECT_EQ(read.value().width, 37u);
    EXPECT_EQ(read.value().height, 21u);
    EXPECT_EQ(read.value().rgb, picture.rgb);
}

TEST(Png, AMissingFolderAnEmptyPictureAndEveryTruncationAreRefusedWithASentence) {
    Picture picture = blank_picture(8, 8);
    const Result<void> missing = write_png(picture, "/no/such/folder/picture.png");
    EXPECT_NE(missing.error().find("/no/such/folder/picture.png"), std::string::npos);
    EXPECT_FALSE(write_png(Picture{}, testing::TempDir() + "cullet_empty.png").ok());
    const TemporaryFile file("cullet_truncated_test.png");
    ASSERT_TRUE(write_png(picture, file.path));
    std::ifstream in(file.path, std::ios::binary);
    const std::string whole((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    in.close();
    const size_t end_chunk = 12;  // libpng does not miss the last one
    for (size_t size = 0; size + end_chunk < whole.size(); ++size) {
        std::ofstream(file.path, std::ios::binary) << whole.substr(0, size);
        const Result<Picture> read = read_png(file.path);
        if (read.ok()) {
            EXPECT_EQ(read.value().rgb, picture.rgb) << size;
        }
    }
}

TEST(Palette, SrgbComesBackAndTheFirstFortyEightFragmentsHaveColoursOfTheirOwn) {
    for (int value = 0; value < 256; ++value)
        EXPECT_NEAR(srgb_from_linear(linear_from_srgb(static_cast<uint8_t>(value))), static_cast<float>(value), 0.35f);
    for (uint32_t a = 0; a < 48; ++a) {
        const Vec3 colour = fragment_colour(a);
        EXPECT_EQ(colour, fragment_colour(a));
        for (uint32_t b = a + 1; b < 48; ++b) EXPECT_GT(length(colour - fragment_colour(b)), 0.01f) << a << ' ' << b;
    }
}

}  // namespace
}  // namespace cullet
