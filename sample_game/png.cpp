#include "sample_game/png.hpp"

#include <png.h>

#include <cstring>

namespace cullet {

namespace {

// libpng's simplified interface: it neither throws nor jumps.
png_image new_image() {
    png_image image;
    std::memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
    return image;
}

Error refused(const std::string& path, const png_image& image, const char* advice) {
    return {path + ": libpng says \"" + image.message + "\"; " + advice};
}

}  // namespace

Result<void> write_png(const Picture& picture, const std::string& path) {
    if (picture.width == 0 || picture.height == 0 || picture.rgb.size() != 3 * size_t{picture.width} * picture.height) {
        return Error{path + ": the picture has " + std::to_string(picture.width) + " x " +
                     std::to_string(picture.height) + " pixels and " + std::to_string(picture.rgb.size()) +
                     " bytes; give 3 bytes a pixel, and at least one pixel."};
    }
    png_image image = new_image();
    image.width = picture.width;
    image.height = picture.height;
    image.format = PNG_FORMAT_RGB;
    image.flags = PNG_IMAGE_FLAG_FAST;
    if (!png_image_write_to_file(&image, path.c_str(), 0, picture.rgb.data(), 0, nullptr))
        return refused(path, image, "check that the folder exists and has room.");
    return {};
}

Result<Picture> read_png(const std::string& path) {
    png_image image = new_image();
    if (!png_image_begin_read_from_file(&image, path.c_str()))
        return refused(path, image, "check that it exists and is a PNG file.");
    image.format = PNG_FORMAT_RGB;
    Picture picture = blank_picture(image.width, image.height);
    const png_color black{0, 0, 0};
    if (!png_image_finish_read(&image, &black, picture.rgb.data(), 0, nullptr))
        return refused(path, image, "the file is damaged; write it again.");
    return picture;
}

}  // namespace cullet
