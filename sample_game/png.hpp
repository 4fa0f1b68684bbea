// A picture in memory and its way to and from a PNG file.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "cullet/result.hpp"

namespace cullet {

/// Eight bits a channel, sRGB, rows from the top, no padding.
struct Picture {
    uint32_t width = 0, height = 0;
    std::vector<uint8_t> rgb;  // 3 width height

    uint8_t* pixel(uint32_t x, uint32_t y) { return rgb.data() + 3 * (size_t{y} * width + x); }
    const uint8_t* pixel(uint32_t x, uint32_t y) const { return rgb.data() + 3 * (size_t{y} * width + x); }
};

/// A black picture.
inline Picture blank_picture(uint32_t width, uint32_t height) {
    return {width, height, std::vector<uint8_t>(3 * size_t{width} * height)};
}

/// Fast compression: about 50 ms and 0.6 MB for 960 x 540.
Result<void> write_png(const Picture& picture, const std::string& path);
/// Any PNG, turned into RGB; transparency lies over black.
Result<Picture> read_png(const std::string& path);

}  // namespace cullet
